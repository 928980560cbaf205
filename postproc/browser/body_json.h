#pragma once
// A body as the page's script reads it: what it is in JSON, its numbers packed beside.

#include "postproc/browser/body.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace pfdm {

/// Numbers, packed (packing.h), under a name.
struct PagePart {
  std::string id, base64;
};

/// Appends to `parts`, at most so many bytes where fewer frames can bring that about: the first and the last always
/// stay. `most_bytes` 0: as much room as a whole body has, or a part of one. `kept`: which frames are left.
nlohmann::ordered_json body_json(Body body, std::vector<PagePart>& parts, std::size_t most_bytes = 0,
                                 std::vector<Index>* kept = nullptr);

}  // namespace pfdm
