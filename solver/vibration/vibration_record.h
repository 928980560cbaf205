#pragma once
// A vibration test as recorded: the base's acceleration and the mass's relative to it, at evenly spaced times.

#include <Eigen/Core>

#include <string>
#include <vector>

namespace pfdm {

struct VibrationRecord {
  std::string name;
  double rate = 0.0;                  ///< samples per second [Hz]
  Eigen::VectorXd base;               ///< y'' [m/s^2]
  Eigen::VectorXd relative;           ///< z'' = x'' - y'' [m/s^2]
  double band_low = 0.0;              ///< what the base excites [Hz]
  double band_high = 0.0;             ///< [Hz]
  std::string remark{};               ///< what its file says about itself
  std::vector<std::string> faults{};  ///< that it has, and with which it can still be used
  Eigen::Index n() const { return base.size(); }
  double duration() const { return static_cast<double>(base.size()) / rate; }  ///< [s]
};

}  // namespace pfdm
