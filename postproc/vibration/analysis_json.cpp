#include "postproc/vibration/analysis_json.h"

#include "physics/point/mass_material.h"
#include "postproc/files/atomic_file.h"
#include "postproc/files/json.h"

namespace pfdm {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const AnalysedRecord& r) {
  Json json = {{"name", r.name},           {"file", r.file},       {"date", r.date ? Json(*r.date) : Json()},
               {"remark", r.remark},       {"motion", r.motion},   {"sampling_rate_Hz", r.rate},
               {"duration_s", r.duration}, {"samples", r.samples}, {"from_Hz", r.band_low},
               {"to_Hz", r.band_high}};
  json["level"] = {{"base_density_g0^2_per_Hz", r.level.base_density / g0_squared},
                   {"rms_base_acceleration_g0", r.level.rms_base / standard_gravity},
                   {"sine_amplitude_g0", r.sine_amplitude ? Json(*r.sine_amplitude / standard_gravity) : Json()},
                   {"rms_base_acceleration_m_per_s2", r.level.rms_base},
                   {"peak_base_acceleration_m_per_s2", r.level.peak_base},
                   {"rms_relative_acceleration_m_per_s2", r.level.rms_relative},
                   {"peak_relative_acceleration_m_per_s2", r.level.peak_relative}};
  json["spectra"] = {{"window", "hann"},       {"segment_samples", r.segment}, {"overlap", r.overlap},
                     {"segments", r.segments}, {"averages", r.averages},       {"resolution_Hz", r.resolution}};
  json["largest_response"] = {{"frequency_Hz", r.resonance.frequency}, {"relative_over_base", r.resonance.response}};
  json["models"] = Json::array();
  for (const ModelMisfit& m : r.misfits) json["models"].push_back({{"name", m.name}, {"relative_misfit", m.relative}});
  return json;
}

}  // namespace

void write_analysis_json(const std::filesystem::path& path, const AnalysisReport& report) {
  Json json = {{"case", report.case_name},
               {"case_hash", report.case_hash},
               {"version", report.version},
               {"analysed", report.analysed}};
  json["records"] = Json::array();
  for (const AnalysedRecord& record : report.records) json["records"].push_back(to_json(record));
  write_file(path, json_text(json));
}

AnalysisStamp read_analysis_stamp(const std::filesystem::path& path) {
  return read_json(path, "analysis", [](const Json& json) {
    return AnalysisStamp{.case_hash = json.at("case_hash"), .analysed = json.at("analysed")};
  });
}

}  // namespace pfdm
