#pragma once
// What a page for the browser holds, and what a browser says of it.

#include <nlohmann/json.hpp>

#include <filesystem>
#include <optional>
#include <string>

namespace pfdm {

nlohmann::json data_of_page(const std::string& html);

/// The block of this caption, or one that begins so. Throws where there is none.
nlohmann::json block_of_page(const nlohmann::json& data, const std::string& caption);

/// A page with a script that puts what `expression` gives, which may wait, and all errors of the page as "errors" into
/// its title; what headless Chromium then has there. Nothing without Chromium.
std::optional<nlohmann::json> told_by_browser(const std::filesystem::path& folder, const std::string& html,
                                              const std::string& expression);

}  // namespace pfdm
