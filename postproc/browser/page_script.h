#pragma once
// The script of a page, which draws what its data say: page.js, made of script/src by script/build.js.

#include <string_view>

namespace pfdm {

std::string_view page_script();

}  // namespace pfdm
