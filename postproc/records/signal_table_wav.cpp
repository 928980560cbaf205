// read_signals_wav() of signal_table.h. The only place that knows libsndfile.

#include "physics/error.h"
#include "postproc/records/signal_table.h"

#include <fmt/format.h>
#include <sndfile.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
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

std::uint32_t number_at(std::string_view bytes, std::size_t at) {  // little-endian
  std::uint32_t n = 0;
  for (std::size_t i = 4; i-- > 0;) n = 256 * n + static_cast<unsigned char>(bytes[at + i]);
  return n;
}

/// Why the file is not one to be read, if so: the library reads other formats too, and of a file that is cut those
/// samples that are there. Walks through the chunks of RIFF: name, size, so many bytes and one more where that is odd.
std::optional<std::string> fault_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  const auto length = static_cast<std::uintmax_t>(std::filesystem::file_size(path));
  std::array<char, 12> head{};
  const auto read = [&](std::uintmax_t at, std::size_t n) {
    file.seekg(static_cast<std::streamoff>(at));
    file.read(head.data(), static_cast<std::streamsize>(n));
    return std::string_view(head.data(), file ? n : 0);
  };
  const std::string_view start = read(0, 12);
  if (start.starts_with("RF64") || start.starts_with("RIFX"))
    return fmt::format("{} files are not read, but RIFF files are: save it as WAV of less than 4 GB",
                       start.substr(0, 4));
  if (!start.starts_with("RIFF") || start.substr(8) != "WAVE")
    return "not a WAV file: it does not begin with RIFF, WAVE";
  constexpr std::uintmax_t unknown = 0xFFFFFFFF;  // of a stream: up to the end
  std::uintmax_t frame = 1;
  for (std::uintmax_t at = 12; at + 8 <= length;) {
    const std::string_view chunk = read(at, 8);
    const std::uintmax_t size = number_at(chunk, 4), left = length - at - 8;
    if (chunk.starts_with("data")) {
      if (size == unknown && left % frame != 0) return "the file is cut short: it ends within a sample";
      if (size <= left || size == unknown) return std::nullopt;
      return fmt::format("the file is cut short: its header promises {} bytes of samples, {} are there", size, left);
    }
    if (chunk.starts_with("fmt ") && left >= 16) frame = std::max(1U, number_at(read(at + 18, 4), 0) >> 16);
    at += 8 + size + size % 2;
  }
  return "the file is cut short: it has no chunk \"data\"";
}

/// Integers or floating-point numbers, not compressed.
bool is_readable(const SF_INFO& info) {
  const int kind = info.format & SF_FORMAT_TYPEMASK, samples = info.format & SF_FORMAT_SUBMASK;
  constexpr int allowed[] = {SF_FORMAT_PCM_U8, SF_FORMAT_PCM_16, SF_FORMAT_PCM_24,
                             SF_FORMAT_PCM_32, SF_FORMAT_FLOAT,  SF_FORMAT_DOUBLE};
  return (kind == SF_FORMAT_WAV || kind == SF_FORMAT_WAVEX) && std::ranges::count(allowed, samples) == 1;
}

}  // namespace

SignalTable read_signals_wav(const std::filesystem::path& path) {
  SF_INFO info{};
  const SoundFile file(sf_open(path.c_str(), SFM_READ, &info), sf_close);
  if (!file) throw InputError(fmt::format("{}: not a WAV file: {}", path.string(), sf_strerror(nullptr)));
  if (const auto fault = fault_of(path)) throw InputError(fmt::format("{}: {}", path.string(), *fault));
  if (!is_readable(info))
    throw InputError(
        fmt::format("{}: the samples are neither integers nor floating-point numbers (format {:#x}): "
                    "save it as WAV without compression",
                    path.string(), info.format));
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
