// A result in memory is what a folder would hold.
#include <gtest/gtest.h>

#include <charconv>
#include <cmath>

#include "results/full_result.h"
#include "results/run_result.h"
#include "results/scratch_folder.h"
#include "support/reading.h"

namespace gapscope {
namespace {

using test::full_result;
using testing::text_of;

std::string cell(const StoredColumn& column, std::size_t row) {
  if (!column.modes.empty()) return to_string(column.modes[row]);
  if (std::isnan(column.numbers[row])) return "";
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, column.numbers[row]).ptr};
}

/// A table as text, numbers at their shortest.
std::string csv(const StoredTable& table) {
  std::string text;
  for (const StoredColumn& c : table.columns) text += (text.empty() ? "" : ",") + c.name;
  for (std::size_t row = 0; row < table.columns.front().numbers.size(); ++row)
    for (std::size_t j = 0; j < table.columns.size(); ++j)
      text += (j == 0 ? "\n" : ",") + cell(table.columns[j], row);
  return text + "\n";
}

TEST(StoredResult, HasTheBytesOfTheFileAndTheColumnsOfItsTraces) {
  const ScratchFolder scratch;
  const std::string folder = scratch.path.string();
  write_run_result(folder, full_result());
  const StoredResult stored = stored_run_result(full_result());
  EXPECT_EQ(stored.json, text_of(folder + "/result.json"));
  ASSERT_EQ(stored.traces.size(), full_result().recordings.size());
  for (const StoredTable& table : stored.traces) {
    EXPECT_NE(table.name.find("traces/"), std::string::npos);
    EXPECT_EQ(csv(table), text_of(folder + "/" + table.name)) << table.name;
  }
}

}  // namespace
}  // namespace gapscope
