// Which formats have what was added to a model.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "exports/export.h"
#include "results/carriage.h"

namespace gapscope {
namespace {

using ::testing::ElementsAre;

TEST(Carriage, HasATableForEveryFormatInItsOrder) {
  const auto tables = target_tables();
  ASSERT_EQ(tables.size(), export_formats().size());
  for (std::size_t i = 0; i < tables.size(); ++i) EXPECT_EQ(tables[i].format, export_formats()[i].name);
}

TEST(Carriage, NamesTheFormatsThatHaveAllThatWasAdded) {
  const auto of = [](const std::string& effect, std::vector<NamedValue> numbers = {}) {
    AddedEffect added;
    added.effect = effect, added.parameters = std::move(numbers);
    return std::vector{added};
  };
  EXPECT_THAT(carriers_of(of("motor_coulomb_friction"), true), ElementsAre("mjcf", "c"));
  EXPECT_THAT(carriers_of(of("cogging_torque"), false), ElementsAre("c"));
  EXPECT_THAT(carriers_of(of("load_dependent_friction"), false), ElementsAre());
  EXPECT_THAT(carried_by_none(of("load_dependent_friction")), ElementsAre("load_dependent_friction"));
  EXPECT_THAT(carriers_of(of("load_unbalance", {{"periods_per_turn", "1/rev", 1.0}}), false),
              ElementsAre("mjcf", "c"));
  EXPECT_THAT(carriers_of(of("load_unbalance", {{"periods_per_turn", "1/rev", 2.0}}), false),
              ElementsAre("c"));
}

}  // namespace
}  // namespace gapscope
