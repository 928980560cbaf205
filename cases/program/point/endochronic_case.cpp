#include "cases/program/point/endochronic_case.h"

#include "cases/program/point/endochronic_case_keys.h"

namespace pfdm {

EndochronicCase read_endochronic_case(const ConfigTable& root, const std::filesystem::path& case_directory) {
  root.with_keys(endochronic_case_keys());
  EndochronicCase result;
  result.title = root.line("title");
  result.law = read_endochronic_law(root.table("material"));
  result.loading = read_endochronic_loading(root.table("loading"), result.law, case_directory);
  if (root.has("fit")) result.fit = read_endochronic_fit(root.table("fit"), result.law, case_directory);
  return result;
}

}  // namespace pfdm
