#include "tests/cases/page_data.h"

#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <stdexcept>

namespace pfdm {
namespace {

/// What a command prints.
std::string said_by(const std::string& command) {
  std::string text;
  FILE* pipe = popen(command.c_str(), "r");
  std::array<char, 4096> buffer{};
  while (pipe && std::fgets(buffer.data(), buffer.size(), pipe)) text += buffer.data();
  if (pipe) pclose(pipe);
  return text;
}

constexpr const char* begin = R"(<script>
(async () => {
  const errors = [];
  addEventListener("error", (e) => errors.push(e.message));
  console.error = (...words) => errors.push(words.join(" "));
  const after = (ms) => new Promise((r) => setTimeout(r, ms));
  const told = await ()";
constexpr const char* end = R"()();
  document.title = "told" + JSON.stringify({ ...told, errors });
})();
</script>)";

}  // namespace

nlohmann::json data_of_page(const std::string& html) {
  const std::string mark = "id=\"pfdm-data\">";
  const std::size_t from = html.find(mark) + mark.size();
  return nlohmann::json::parse(html.substr(from, html.find("</script>", from) - from));
}

nlohmann::json block_of_page(const nlohmann::json& data, const std::string& caption) {
  for (const char* list : {"first", "blocks"})
    if (data.contains(list))
      for (const auto& one : data[list])
        if (one["caption"].get<std::string>().starts_with(caption)) return one;
  throw std::runtime_error("the page has no \"" + caption + "\"");
}

std::optional<nlohmann::json> told_by_browser(const std::filesystem::path& folder, const std::string& html,
                                              const std::string& expression) {
  if (said_by("command -v chromium").empty()) return std::nullopt;
  std::ofstream(folder / "probe.html") << html << begin << expression << end;
  const std::string page = said_by(
      fmt::format("HOME={0} timeout 300 chromium --headless=new --no-sandbox --use-gl=angle --use-angle=swiftshader "
                  "--enable-unsafe-swiftshader --window-size=1280,900 --virtual-time-budget=15000 --dump-dom "
                  "file://{0}/probe.html 2>/dev/null",
                  folder.string()));
  const std::string mark = "<title>told";
  const std::size_t from = page.find(mark);
  if (from == std::string::npos) throw std::runtime_error("the browser told nothing");
  const std::size_t json = from + mark.size();
  return nlohmann::json::parse(page.substr(json, page.find("</title>", json) - json));
}

}  // namespace pfdm
