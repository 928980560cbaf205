#pragma once
// Meshes that several runs of one case share, whatever other values they run with.

#include "mesh/mesh.h"

#include <functional>
#include <map>
#include <string>

namespace pfdm {

class MeshStore {
 public:
  /// The mesh that was made under this key, or else made now. The reference stays valid.
  const Mesh& get(const std::string& key, const std::function<Mesh()>& make) {
    const auto found = meshes_.find(key);
    return found != meshes_.end() ? found->second : meshes_.emplace(key, make()).first->second;
  }

 private:
  std::map<std::string, Mesh> meshes_;
};

}  // namespace pfdm
