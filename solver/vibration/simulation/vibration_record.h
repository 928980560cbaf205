#pragma once
// A vibration test as recorded: the base's acceleration and the mass's relative to it, at evenly spaced times.

#include <Eigen/Core>

#include <string>
#include <vector>

namespace pfdm {

/// Motion of the mass relative to the base at one time.
struct InitialMotion {
  double displacement = 0.0;  ///< z [m]
  double velocity = 0.0;      ///< z' [m/s]
  bool is_rest() const { return displacement == 0.0 && velocity == 0.0; }
};

struct VibrationRecord {
  std::string name;
  double rate = 0.0;                  ///< samples per second [Hz]
  Eigen::VectorXd base;               ///< y'' [m/s^2]
  Eigen::VectorXd relative;           ///< z'' = x'' - y'' [m/s^2]
  double band_low = 0.0;              ///< what the base excites [Hz]
  double band_high = 0.0;             ///< [Hz]
  std::string remark{};               ///< what its file says about itself
  std::vector<std::string> faults{};  ///< that it has, and with which it can still be used
  InitialMotion start{};              ///< with which a simulation of the test begins
  Eigen::Index n() const { return base.size(); }
  double duration() const { return static_cast<double>(base.size()) / rate; }  ///< [s]
};

}  // namespace pfdm
