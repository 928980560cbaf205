#pragma once
// What VTK's readers complain of, kept from standard error.

#include <memory>
#include <string>

namespace pfdm {

/// From its making on until its end VTK prints nothing; what it would have printed is kept.
class CaughtVtkMessages {
 public:
  CaughtVtkMessages();
  ~CaughtVtkMessages();
  CaughtVtkMessages(const CaughtVtkMessages&) = delete;
  CaughtVtkMessages& operator=(const CaughtVtkMessages&) = delete;

  /// No error so far; warnings do not count.
  bool none() const;
  /// The first error, without the place in VTK's sources.
  std::string first() const;

 private:
  struct Catch;
  std::unique_ptr<Catch> catch_;
};

}  // namespace pfdm
