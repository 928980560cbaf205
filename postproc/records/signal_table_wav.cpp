// read_signals_wav() of signal_table.h. The only place that knows libsndfile.

#include "physics/error.h"
#include "postproc/records/signal_table.h"

#include <fmt/format.h>
#include <sndfile.h>

#include <array>
#include <memory>
#include <string_view>

namespace pfdm {
namespace {

using SoundFile = std::unique_ptr<SNDFILE, decltype(&sf_close)>;

/// Title and comment, a line each.
std::string remark_of(SNDFILE* file) {
  std::string remark;
  for (const int kind : {SF_STR_TITLE, SF_STR_COMMENT})
    if (const char* text = sf_get_string(file, kind); text != nullptr && *text != '\0')
      remark += (remark.empty() ? "" : "\n") + std::string(text);
  return remark;
}

/// Whether the samples that the header promises are not all there: the library reads those that are, and says so only
/// in its log, as "data : 72 (should be 42)".
bool is_cut(SNDFILE* file) {
  std::array<char, 4096> text{};
  sf_command(file, SFC_GET_LOG_INFO, text.data(), static_cast<int>(text.size() - 1));
  const std::string_view log(text.data());
  const auto data = log.find("\ndata : ");
  if (data == std::string_view::npos) return false;
  return log.substr(data + 1, log.find('\n', data + 1) - data - 1).find("should be") != std::string_view::npos;
}

}  // namespace

SignalTable read_signals_wav(const std::filesystem::path& path) {
  SF_INFO info{};
  const SoundFile file(sf_open(path.c_str(), SFM_READ, &info), sf_close);
  if (!file) throw InputError(fmt::format("{}: not a WAV file: {}", path.string(), sf_strerror(nullptr)));
  if (is_cut(file.get()))
    throw InputError(fmt::format("{}: the file is cut short: its header promises more samples", path.string()));
  if (info.frames < 1) throw InputError(fmt::format("{}: the file has no samples", path.string()));
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> samples(info.frames, info.channels);
  const auto n = sf_readf_double(file.get(), samples.data(), info.frames);
  if (n != info.frames) throw InputError(fmt::format("{}: cannot be read to its end", path.string()));
  SignalTable table{.remark = remark_of(file.get()), .columns = {}};
  const double last = static_cast<double>(info.frames - 1);
  table.columns.push_back({"time", "s", Eigen::VectorXd::LinSpaced(info.frames, 0.0, last) / info.samplerate});
  for (int i = 0; i < info.channels; ++i)
    table.columns.push_back({fmt::format("channel_{}", i + 1), "", samples.col(i)});
  return table;
}

}  // namespace pfdm
