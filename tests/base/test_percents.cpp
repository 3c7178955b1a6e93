#include <gtest/gtest.h>

#include <initializer_list>
#include <string>
#include <vector>

#include "base/percents.h"
#include "gapscope/base/statistics.h"

namespace gapscope {
namespace {

std::string column(std::initializer_list<double> together) {
  const Percents percent(std::vector<double>{together});
  std::string text;
  for (const double p : together) text += (text.empty() ? "" : ", ") + percent(p);
  return text;
}

TEST(Percents, ThatStandTogetherHaveTheSameDecimals) {
  EXPECT_EQ(column({17.14, 3.0, 2.5}), "17.1 %, 3.0 %, 2.5 %");
  EXPECT_EQ(column({64.0, 12.3}), "64 %, 12 %");
  EXPECT_EQ(column({0.286, 0.05}), "0.286 %, 0.050 %");
}

TEST(Percents, OfTheLargestShowNoMoreThanFourDigits) {
  EXPECT_EQ(column({413.26, 0.18, 0.0}), "413.3 %, 0.2 %, 0.0 %");
  EXPECT_EQ(column({25000.0, 0.18}), "25000 %, 0 %");
}

TEST(Percents, WhatIsNoNumberIsADashAndCountsForNothing) {
  EXPECT_EQ(column({kNaN, 2.5, kInfinity}), "–, 2.5 %, –");
  EXPECT_EQ(column({}), "");
}

}  // namespace
}  // namespace gapscope
