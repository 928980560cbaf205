#pragma once
// Laws that are written in Python: objects of the package's OwnInterfaceLaw, OwnMaterial and OwnHyperelastic, asked by
// whichever thread computes. What their respond() raises ends the step.

#include "cases/python/extension/arrays.h"
#include "mesh/mesh.h"
#include "solver/fracture/model/fracture_model.h"

#include <map>
#include <span>
#include <string>

namespace pfdm {

/// By the names of the interfaces, and of the regions, whose laws they take the place of.
struct ScriptLaws {
  std::map<std::string, py::object> interfaces, materials;
};

/// Puts the laws into the model of a case. Throws InputError for names that there are not, and for what a law in
/// Python cannot be combined with.
void put_into_model(const ScriptLaws& laws, const Mesh& mesh, FractureModel& model);

/// What tells runs of different laws apart: places and types, not what the objects hold.
std::string words_of(const ScriptLaws& laws);

/// Whether this thread is within respond() of such a law.
bool is_within_script_law();

/// At finite strain what it answers of an opened face has to pull along the separation.
std::shared_ptr<const OwnInterfaceLaw> make_script_interface(const std::string& place, const py::object& law,
                                                             bool is_finite_strain);
std::shared_ptr<const Material> make_script_material(const std::string& place, const py::object& law,
                                                     const IsotropicElasticity& elasticity);
/// With the strain energy of this law in place of that of `known`, a material of finite strain; its volume energy,
/// pressure and branches stay. Throws InputError for derivatives that are not those of the energy.
std::shared_ptr<const Material> make_script_hyperelastic(const std::string& place, const py::object& law,
                                                         const Material& known);

/// The object, and what it has said of itself.
class ScriptLaw {
 public:
  /// `place`, as in "interfaces[\"glue\"]", is for messages. Throws InputError unless its history has at most so many
  /// numbers. Its respond() returns so many entries.
  ScriptLaw(std::string place, const py::object& law, std::size_t most_numbers, std::size_t n_entries = 5);
  ScriptLaw(const ScriptLaw&) = delete;
  ScriptLaw& operator=(const ScriptLaw&) = delete;
  ~ScriptLaw();

  std::size_t history_size() const { return history_size_; }
  bool depends_on_rate() const { return depends_on_rate_; }

  /// The interpreter's lock, for as long as a law is asked.
  class Turn {
   public:
    Turn();
    ~Turn();
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;

   private:
    py::gil_scoped_acquire lock_;
  };

  /// What respond() has returned: arrays and numbers.
  class Answer {
   public:
    /// Element by element in rows, into an array of this shape. Throws InputError for another shape.
    void read(std::size_t entry, const char* name, const std::vector<py::ssize_t>& shape, double* to) const;
    /// Likewise, and throws InputError for numbers that are not finite.
    void read_finite(std::size_t entry, const char* name, const std::vector<py::ssize_t>& shape, double* to) const;
    /// Finite, too.
    double number(std::size_t entry, const char* name) const;
    /// It may be infinite, or no number.
    double any_number(std::size_t entry, const char* name) const;
    bool is_none(std::size_t entry) const { return entries_[entry].is_none(); }
    /// An energy that a step has dissipated. Throws InputError where it is less than -`rounding`.
    double dissipated(std::size_t entry, double rounding) const;

   private:
    friend class ScriptLaw;
    Answer(const ScriptLaw& law, py::tuple entries) : law_(law), entries_(std::move(entries)) {}
    const ScriptLaw& law_;
    py::tuple entries_;
  };

  /// Within a Turn. Throws what respond() raises, and InputError for an answer of another number of entries.
  template <class... Arguments>
  Answer respond(const Arguments&... arguments) const {
    return answer(respond_(arguments...));
  }

 private:
  Answer answer(const py::object& returned) const;

  std::string place_;
  py::object respond_;
  std::size_t n_entries_ = 0;
  std::size_t history_size_ = 0;
  bool depends_on_rate_ = false;
};

}  // namespace pfdm
