// A law of one's own in place of those of the tables: here it asks one of them.

#include "physics/interfaces/interface_law.h"
#include "tests/physics/glued_interfaces.h"

#include <gtest/gtest.h>

#include <memory>

namespace pfdm::this_file {
namespace {

using namespace glued_interfaces;

class Asking final : public OwnInterfaceLaw {
 public:
  explicit Asking(InterfaceLaw law) : law_(std::move(law)) {}
  bool depends_on_rate() const override { return true; }
  InterfaceResponse respond(const InterfaceStrength& at, const Vector& normal, const Vector& separation,
                            const InterfaceHistory& before, double duration) const override {
    return law_.respond(at, normal, separation, before, duration);
  }

 private:
  InterfaceLaw law_;
};

/// The law "linear" asked by one that stands in place of "xu_needleman".
class OwnLaw : public testing::Test {
 protected:
  InterfaceLaw known = interface_with(law_named("linear"), "camacho_ortiz", 1.0);
  InterfaceLaw own = interface_with(law_named("xu_needleman"), "camacho_ortiz", 1.0);
  void SetUp() override { own.own_law = std::make_shared<const Asking>(known); }
};

TEST_F(OwnLaw, Responds) {
  const Vector opened = 2e-5 * (0.8 * n + 0.6 * s);
  const InterfaceResponse due = known.respond(glued, n, opened, {}), found = own.respond(glued, n, opened, {});
  EXPECT_GT(due.history.dissipated, 0.0);
  EXPECT_EQ(found.traction, due.traction);
  EXPECT_EQ(found.tangent, due.tangent);
  EXPECT_EQ(found.history, due.history);
}

TEST_F(OwnLaw, FallsAsSteeplyInOpening) {
  EXPECT_GT(known.steepest_fall(glued), 0.0);
  EXPECT_DOUBLE_EQ(own.steepest_fall(glued), known.steepest_fall(glued));
}

TEST_F(OwnLaw, IsDamagedByWhatItHasDissipatedOfTheToughness) {
  InterfaceHistory history;
  EXPECT_EQ(own.damage(glued, n, Vector::Zero(), history), 0.0);
  history.dissipated = 0.25 * glued.toughness;
  EXPECT_DOUBLE_EQ(own.damage(glued, n, Vector::Zero(), history), 0.25);
  history.dissipated = 2.0 * glued.toughness;
  EXPECT_DOUBLE_EQ(own.damage(glued, n, Vector::Zero(), history), 1.0);
}

TEST_F(OwnLaw, SaysWhetherItDependsOnTheRateAndHasNoRise) {
  EXPECT_TRUE(own.depends_on_rate());
  InterfaceStrength soft = glued;
  soft.stiffness = 0.1 * glued.strength * glued.strength / glued.toughness;
  EXPECT_TRUE(known.is_all_rise(soft));
  own.law = known.law;
  EXPECT_FALSE(own.is_all_rise(soft));
}

}  // namespace
}  // namespace pfdm::this_file
