#pragma once
// Memory of the gaps at the faces of relaxing cells (physics/materials/prony.h, gap_memory.h). The law is linear, so
// that a gap z [-] is a strain that it bears as any other. The traction of a branch is its modulus times r, r' + r/tau
// = z', and relaxes with it. A gap that met the instantaneous moduli for ever would make a body that has relaxed too
// stiff. Cells with a pressure remember their volume changes likewise, by their gradient and by the flux through their
// faces. The moderate bulk modulus K_s, which bears the difference (CellMechanics::volume_changes), relaxes as the
// shear modulus does. So every term of the discrete body is that of the elastic one with relaxing moduli
// (correspondence principle): what is stable for all elastic moduli is stable in time. With an elastic K_s, or with
// both remainders in the pressures, which are extrapolated to the faces, rough modes grew. In plane stress at small
// strain gaps meet the shear modulus of the moment and the Poisson's ratio at once: the modulus along a face's normal
// is not linear in mu, so that the parts of the branches would not add up. At finite strain gaps are turned back with
// their cell (finite_memory.h).

#include "physics/materials/prony.h"
#include "solver/fracture/gaps/gap_memory.h"

#include <span>
#include <vector>

namespace pfdm {

class RelaxingGaps : public GapMemory {
 public:
  /// Gaps of cells with these materials; null: elastic; empty: all elastic.
  RelaxingGaps(const Mesh& mesh, const CellField<const Material*>& materials, const FractureModel& model);

  bool any() const override { return !kinds_.empty(); }
  bool has(Index cell) const override { return any() && kind_[cell] >= 0; }
  std::size_t size(Index cell) const override;
  void start_step(double duration, const CellField<double>& shift) override;
  IsotropicElasticity elasticity(Index cell) const override { return moment(cell).elasticity; }
  double in_branches(std::span<const double> numbers) const override;
  void tell(Index cell, std::span<const double> numbers, HistoryStress& history) const override {
    tell(cell, numbers, At::end, history);
  }
  void hold(Index cell, std::span<double> numbers) const override;
  void advance(Index cell, double, const CellMechanics& now, std::span<const double> from,
               std::span<double> to) override {
    advance(cell, now.volume_changes[cell], now.gaps, from, to);
  }

  /// The time in a step of which numbers are.
  enum class At { start, end };
  /// As tell() of the base, of the numbers at either time.
  void tell(Index cell, std::span<const double> numbers, At at, HistoryStress& history) const;
  /// As advance() of the base, to volume changes and gaps, the latter as Mesh::cell_faces.
  void advance(Index cell, const VolumeChanges& changes, const std::vector<FaceGap>& gaps, std::span<const double> from,
               std::span<double> to) const;

 private:
  struct Kind {
    const PronyLaw* law;
    bool has_pressure = false;
    bool keeps_ratio = false;  // gaps have the Poisson's ratio at once
    // Energies; with a pressure also the two volume changes, and what is left of both in each shear branch.
    std::size_t per_cell() const { return 3 + (has_pressure ? 2 + 2 * law->shear.size() : 0); }
    std::size_t bulk_from() const { return 3 + 3 * law->shear.size(); }  // among the numbers of a face
    std::size_t per_face() const { return bulk_from() + (law->bulk.empty() ? 0 : 1 + law->bulk.size()); }
  };
  // What a kind has in a step of its duration.
  struct Moment {
    std::vector<PronyDecay> shear{}, bulk{};
    IsotropicElasticity elasticity{};
  };
  static Moment moment_of(const Kind& kind, double duration);
  const Kind& kind(Index cell) const { return kinds_[kind_[cell]]; }
  const Moment& moment(Index cell) const { return moments_[is_shifted_ ? cell : kind_[cell]]; }

  const Mesh& mesh_;
  std::vector<Kind> kinds_;
  std::vector<Moment> moments_;  // of the step, by kind, or by cell
  bool is_shifted_ = false;      // by cell
  CellField<Index> kind_;        // -1: none
};

}  // namespace pfdm
