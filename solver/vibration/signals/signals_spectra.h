#pragma once
// Spectral densities by averaging over windowed segments (Welch 1967), frequency responses, coherence, spectrograms.
// Densities are one-sided. Conventions and scaling are those of SciPy's welch, csd, coherence and spectrogram.

#include <Eigen/Core>

namespace pfdm {

struct SegmentSettings {
  Eigen::Index length = 8192;  ///< samples in a segment
  double overlap = 0.5;        ///< of neighbouring segments
  bool remove_mean = true;     ///< of each segment
};

/// Of input x and output y; Sxy = mean of conj(X) Y.
struct Spectra {
  Eigen::VectorXd frequency;  ///< [Hz]
  Eigen::VectorXd Sxx;        ///< [x^2/Hz]
  Eigen::VectorXd Syy;        ///< [y^2/Hz]
  Eigen::VectorXcd Sxy;       ///< [x y/Hz]
  Eigen::Index segments = 0;
  double averages = 0.0;  ///< how many independent segments would leave the same variance: overlapping ones are not
};

/// Segments wholly within the record. Throws InputError if it is shorter than one.
Spectra spectra(const Eigen::VectorXd& x, const Eigen::VectorXd& y, double rate, const SegmentSettings& settings = {});
Eigen::VectorXd spectral_density(const Eigen::VectorXd& x, double rate, const SegmentSettings& settings = {});

/// Hann's window for spectra: periodic, w_n = (1 - cos(2 pi n/N))/2.
Eigen::VectorXd hann_window(Eigen::Index n);

Eigen::VectorXd coherence(const Spectra& s);  ///< gamma^2 = |Sxy|^2/(Sxx Syy)

enum class ResponseEstimator {
  h1,  ///< Sxy/Sxx: noise on the output alone leaves it unbiased
  h2,  ///< Syy/conj(Sxy): noise on the input alone does
  hv,  ///< their geometric mean: the same relative noise on both does
};
Eigen::VectorXcd frequency_response(const Spectra& s, ResponseEstimator estimator);

/// Two-sided bounds at each frequency.
struct Bounds {
  Eigen::VectorXd lower;
  Eigen::VectorXd upper;
};
/// Standard deviation of |H1| over |H1|: sqrt((1 - gamma^2)/(2 gamma^2 n)) (Bendat and Piersol, Random Data, 4th ed.,
/// eq. 9.90); that of the phase [rad] is the same.
Eigen::VectorXd relative_response_deviation(const Spectra& s);
/// |H1| within `deviations` standard deviations.
Bounds response_bounds(const Spectra& s, double deviations = 1.96);
/// Of gamma^2, by Fisher's transform: artanh(gamma) has the standard deviation 1/sqrt(2 n).
Bounds coherence_bounds(const Spectra& s, double deviations = 1.96);

struct Spectrogram {
  Eigen::VectorXd time;       ///< middle of each segment [s]
  Eigen::VectorXd frequency;  ///< [Hz]
  Eigen::MatrixXd density;    ///< [x^2/Hz], a column per time
};
Spectrogram spectrogram(const Eigen::VectorXd& x, double rate, const SegmentSettings& settings = {});

}  // namespace pfdm
