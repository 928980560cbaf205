#pragma once
// Messages as a person can read them, whatever is in the names and files that they quote.

#include <string>
#include <string_view>

namespace pfdm {

/// The message on one line, without control characters and without bytes that are no UTF-8 (as \x1b). Words that are
/// longer than 120 bytes, paths than 250, keep their ends and tell how long they are; so does a message above 2000. Of
/// a message that has more than 290 bytes beside the folders of files that it names by their whole paths, words have
/// 45, and the end of its longest list in parentheses is left out, as far as is needed, as in "(allowed: a, b, ... 7
/// more)".
std::string message_text(std::string_view message);

/// Likewise, and the middle of what is still longer than that is left out.
std::string error_text(std::string_view message);

}  // namespace pfdm
