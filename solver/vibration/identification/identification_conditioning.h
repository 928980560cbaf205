#pragma once
// All signals of a record brought into the same state: the same zero-phase band, only as many samples as that band
// needs, and both ends cut off, where filters and integration leave transients. What is nonlinear has to be formed
// before: powers of a filtered signal are not the filtered powers. And the linear systems that regressions make of
// them.

#include "solver/vibration/identification/identification_values.h"
#include "solver/vibration/signals/signals_filter.h"
#include "solver/vibration/simulation/vibration_record.h"

#include <Eigen/Core>

#include <complex>
#include <functional>
#include <span>
#include <utility>
#include <vector>

namespace pfdm {

class Conditioner {
 public:
  /// For signals of n samples; `crop` is the part cut off at either end.
  Conditioner(Eigen::Index n, double rate, const PassBand& band, double crop);

  /// Of a signal at the record's rate or one that reduced() has brought to the lower rate.
  Eigen::VectorXd operator()(const Eigen::Ref<const Eigen::VectorXd>& signal) const;
  /// In two steps: the spectrum within the band, not yet filtered, which may be multiplied by a transfer function ...
  Eigen::VectorXcd spectrum(const Eigen::Ref<const Eigen::VectorXd>& signal) const;
  /// ... and from there to the samples.
  Eigen::VectorXd samples(const Eigen::VectorXcd& spectrum) const;

  /// The whole signal at the lower rate that the band needs, not filtered otherwise.
  Eigen::VectorXd reduced(const Eigen::Ref<const Eigen::VectorXd>& signal) const;

  const Eigen::VectorXd& omega() const { return omega_; }  ///< of the spectrum's entries [rad/s]
  Eigen::Index n_samples() const { return n_kept_; }
  double rate() const { return rate_; }  ///< of what comes out [Hz]

 private:
  Eigen::Index n_;          // samples that come in
  Eigen::Index length_;     // with zeros up to a fast length
  Eigen::Index reduced_;    // length of the reduced signal
  Eigen::Index n_reduced_;  // without the zeros
  Eigen::Index first_;
  Eigen::Index n_kept_;
  double rate_;
  Eigen::VectorXd at_reduced_rate(const Eigen::VectorXcd& spectrum) const;

  Eigen::VectorXd gain_;
  Eigen::VectorXd omega_;
};

/// The states of the model at the record's own rate: z and z' by Fourier integration of z'' above a part of the lowest
/// excited frequency.
struct States {
  Eigen::VectorXd displacement;  ///< [m]
  Eigen::VectorXd velocity;      ///< [m/s]
};
States integrate_states(const VibrationRecord& record);

/// A record, ready to deliver columns of a regression.
struct PreparedRecord {
  Conditioner condition;
  States states;
  Eigen::VectorXcd force;                ///< spectrum of -m (z'' + y'')
  std::vector<Eigen::VectorXcd> powers;  ///< spectra of z, z^2 ...
  Eigen::VectorXcd velocity;
  double weight = 1.0;  ///< so that every record counts alike
  double low = 0.0;     ///< end of the band that is excited [Hz]
  double high = 0.0;    ///< likewise [Hz]
};

/// Records in the band of their excitation, and of its first harmonic where the stiffness is nonlinear.
std::vector<PreparedRecord> prepare_all(std::span<const VibrationRecord> records, const ModelStructure& structure,
                                        const IdentificationSettings& settings);

/// Spectrum of z' |z'/V|^lambda, V = `reference` [m/s].
Eigen::VectorXcd shaped_velocity(const PreparedRecord& p, double lambda, double reference);

/// Columns of all records below each other, each record weighted.
struct RecordSystem {
  Eigen::MatrixXd A;
  Eigen::VectorXd q;
};

/// Columns of a record, and its left side.
using RecordColumns = std::function<std::pair<std::vector<Eigen::VectorXd>, Eigen::VectorXd>(const PreparedRecord&)>;

/// Puts the columns of all records together.
RecordSystem assemble(std::span<const PreparedRecord> prepared, const RecordColumns& columns);

}  // namespace pfdm
