#include "cases/program/fracture/case/frame_settings.h"

#include <cmath>
#include <span>
#include <string_view>
#include <utility>

namespace pfdm {
namespace {

FrameSettings measured_in(double per_load, std::string unit) {
  return {.time_per_load = per_load, .file = {.compression = {}, .time_unit = std::move(unit)}};
}

FrameSettings by_time(const ConfigValue& wanted, const LoadingSettings& loading, const std::optional<double>&) {
  if (!(loading.duration > 0.0)) throw wanted.error("this needs [loading] duration");
  return measured_in(loading.duration, "s");
}

FrameSettings by_displacement(const ConfigValue& wanted, const LoadingSettings&, const std::optional<double>& full) {
  if (!full)
    throw wanted.error(
        "the displacement of the curve's patch is not prescribed by a plain quantity along the curve's component: it "
        "may decrease, and times must increase; use \"load\" or \"step\"");
  return measured_in(std::abs(*full), "m");
}

FrameSettings by_load(const ConfigValue&, const LoadingSettings&, const std::optional<double>&) {
  return measured_in(1.0, "1");
}

FrameSettings by_step(const ConfigValue&, const LoadingSettings&, const std::optional<double>&) {
  return measured_in(0.0, "1");
}

struct TimeValue {
  std::string_view name;
  FrameSettings (*settings)(const ConfigValue& wanted, const LoadingSettings& loading,
                            const std::optional<double>& full_displacement);
  bool rises_whatever_the_load;
};

constexpr TimeValue time_values[] = {{"displacement", by_displacement, false},
                                     {"time", by_time, false},
                                     {"load", by_load, false},
                                     {"step", by_step, true}};

FrameSettings read_time_value(const ConfigValue& wanted, const LoadingSettings& loading,
                              const std::optional<double>& full_displacement) {
  const TimeValue& value = choose(wanted, std::span<const TimeValue>(time_values), "time value");
  if (loading.controls_dissipation() && !value.rises_whatever_the_load)
    throw wanted.error("with loading.maximum_dissipation the load may decrease, and times must increase; use \"step\"");
  return value.settings(wanted, loading, full_displacement);
}

FrameSettings usual_time_value(const LoadingSettings& loading, const std::optional<double>& full_displacement) {
  if (loading.controls_dissipation()) return measured_in(0.0, "1");
  if (loading.duration > 0.0) return measured_in(loading.duration, "s");
  if (full_displacement) return measured_in(std::abs(*full_displacement), "m");
  return measured_in(1.0, "1");
}

struct CompressionName {
  std::string_view name;
  Compression compression;
};

constexpr CompressionName compressions[] = {
    {"zlib", Compression::zlib}, {"lz4", Compression::lz4}, {"none", Compression::none}};

struct FrameFormat {
  std::string_view name;
  bool in_one_file;
};

constexpr FrameFormat formats[] = {{"vtu", false}, {"vtkhdf", true}};

}  // namespace

FrameSettings read_frame_settings(const ConfigTable& output, const LoadingSettings& loading,
                                  const std::optional<double>& full_displacement) {
  const auto wanted = output.find("time_value");
  FrameSettings settings =
      wanted ? read_time_value(*wanted, loading, full_displacement) : usual_time_value(loading, full_displacement);
  if (const auto compression = output.find("compression"))
    settings.file.compression =
        choose(*compression, std::span<const CompressionName>(compressions), "compression").compression;
  if (const auto format = output.find("format"))
    settings.in_one_file = choose(*format, std::span<const FrameFormat>(formats), "format").in_one_file;
  return settings;
}

}  // namespace pfdm
