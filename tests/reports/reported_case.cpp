#include "tests/reports/reported_case.h"

namespace pfdm {

ReportedCase::ReportedCase(const std::string& folder) : directory_("") {
  namespace fs = std::filesystem;
  fs::copy(fs::path(PFDM_REPORTS_DIR) / folder, path(),
           fs::copy_options::recursive | fs::copy_options::overwrite_existing);
}

Outcome ReportedCase::run(const std::string& command, const std::string& file) const {
  return pfdm::run({command, (path() / file).string()});
}

nlohmann::json ReportedCase::json(const std::string& file) const {
  return nlohmann::json::parse(content_of(results() / file));
}

}  // namespace pfdm
