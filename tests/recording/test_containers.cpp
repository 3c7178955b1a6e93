// Columns that stand deeper in a file: in structs, in lists of rollouts, in entries with rows of their own.
#include <fmt/format.h>

#include <cmath>
#include <cstring>

#include "recording/array_fixture.h"
#include "recording/axes.h"
#include "support/mat_file.h"

namespace gapscope {
namespace {

using testing::columns_named;
using ::testing::Contains;
using ::testing::HasSubstr;
using testing::MatWriter;
using testing::TemporaryFile;

constexpr int kDeepRows = 80;

std::vector<double> series(double factor, int columns = 1) {
  std::vector<double> values;
  for (int i = 0; i < kDeepRows * columns; ++i) values.push_back(factor * std::sin(0.1 * i));
  return values;
}

std::vector<double> times_of(double step) {
  std::vector<double> t;
  for (int i = 0; i < kDeepRows; ++i) t.push_back(step * i);
  return t;
}

TEST(Containers, AStructOfSimulinkGivesItsSignals) {
  for (const matio_compression compression : {MAT_COMPRESSION_NONE, MAT_COMPRESSION_ZLIB}) {
    const TemporaryFile place("");
    const std::string path = (place.folder() / "rec.mat").string();
    MatWriter(path, MAT_FT_MAT5, compression)
        .column("alone", series(5.0))
        .structure_with_time("rec", times_of(0.01), series(1.0), series(2.0, 2));
    const Recording r = read_recording(
        path, columns_named("rec.time", "rec.signals(2).values(:,2)", "rec.signals(1).values"));
    ASSERT_EQ(r.size(), static_cast<std::size_t>(kDeepRows));
    EXPECT_DOUBLE_EQ(r.dt, 0.01);
    EXPECT_DOUBLE_EQ(r.x1[7], std::sin(0.7));
    EXPECT_DOUBLE_EQ(r.u[7], 2.0 * std::sin(0.1 * (kDeepRows + 7)));
    EXPECT_THAT(recorded_names(path), Contains("rec.signals(2).values"));
    const auto refused = [&](const char* position) {
      return testing::refusal([&] { read_recording(path, columns_named("rec.time", "alone", position)); });
    };
    EXPECT_THAT(refused("rec"), HasSubstr("the variable 'rec' is a struct"));
    EXPECT_THAT(refused("rec.signals(3).values"), HasSubstr("'rec.signals(1).values'"));
  }
}

TEST(Containers, ADamagedStructIsRefusedOrRead) {
  const TemporaryFile place("");
  const std::string path = (place.folder() / "rec.mat").string();
  MatWriter(path, MAT_FT_MAT5, MAT_COMPRESSION_NONE)
      .structure_with_time("rec", times_of(0.01), series(1.0), series(2.0, 2));
  const std::string whole = testing::text_of(path);
  for (std::size_t at = 128; at < 900; at += 4)
    for (const char by : {'\0', '\x7f', '\xff'}) {
      std::string bytes = whole;
      bytes[at] = by;
      std::ofstream(path, std::ios::binary) << bytes;
      testing::refusal([&] {
        read_recording(path, columns_named("rec.time", "rec.signals(1).values", "rec.signals(1).values"));
      });
    }
}

std::string rollouts() {
  std::string actions, q;
  for (int i = 0; i < kDeepRows; ++i) {
    actions += fmt::format("{}[{}, 7]", i == 0 ? "" : ",", 0.5 * i);
    q += fmt::format("{}{}", i == 0 ? "" : ",", 0.01 * i);
  }
  const std::string one =
      fmt::format(R"({{"actions": [{}], "obs": {{"q": [{}]}}, "done": true}})", actions, q);
  return fmt::format(R"({{"data": [{}, {}], "env": "arm"}})", one, one);
}

TEST(Containers, RolloutsAreNamedByTheirPath) {
  const TemporaryFile file(rollouts(), "r.json");
  ReadOptions options = columns_named("t", "data[1].actions[:, 0]", "data[1].obs.q");
  options.columns.rate = 50.0;
  const Recording r = read_recording(file.path(), options);
  ASSERT_EQ(r.size(), static_cast<std::size_t>(kDeepRows));
  EXPECT_DOUBLE_EQ(r.dt, 0.02);
  EXPECT_EQ(r.u[9], 4.5);
  EXPECT_EQ(r.x1[9], 0.09);
  EXPECT_THAT(recorded_names(file.path()), Contains("data[0].actions"));
  options.columns.position = "data[2].obs.q";
  EXPECT_THAT(testing::refusal([&] { read_recording(file.path(), options); }),
              AllOf(HasSubstr("there is no column 'data[2].obs.q'"), HasSubstr("'data[0].obs.q'")));
}

/// A log of WPILib with two entries whose times differ.
std::string wpilog() {
  const auto number = [](std::uint64_t value, std::size_t bytes) {
    std::string raw;
    for (std::size_t i = 0; i < bytes; ++i) raw += static_cast<char>(value >> (8 * i) & 0xff);
    return raw;
  };
  const auto record = [&](std::uint64_t entry, std::uint64_t time, const std::string& payload) {
    return number(0x7f, 1) + number(entry, 4) + number(payload.size(), 4) + number(time, 8) + payload;
  };
  const auto text = [&](const std::string& t) { return number(t.size(), 4) + t; };
  const auto start = [&](std::uint64_t entry, const std::string& name, const std::string& type) {
    return record(0, 0, number(0, 1) + number(entry, 4) + text(name) + text(type) + text(""));
  };
  const auto real = [&](double value) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, 8);
    return number(bits, 8);
  };
  std::string log = "WPILOG" + number(0x100, 2) + text("");
  log += start(1, "arm/position", "double") + start(2, "arm/voltage", "double") + start(3, "note", "string");
  for (std::uint64_t i = 0; i < kDeepRows; ++i) {
    const double x = static_cast<double>(i);
    log += record(2, 1000000 + 20000 * i - 1000, real(0.1 * x)) + record(3, 1000000 + 20000 * i, "on");
    log += record(1, 1000000 + 20000 * i, real(std::sin(0.1 * x)));
  }
  return log;
}

TEST(Containers, EntriesOfAWpilogMeetAtTheRowsOfThePosition) {
  const TemporaryFile file(wpilog(), "arm.wpilog");
  const Recording r = read_recording(file.path(), columns_named("t", "arm/voltage", "arm/position"));
  ASSERT_EQ(r.size(), static_cast<std::size_t>(kDeepRows));
  EXPECT_DOUBLE_EQ(r.dt, 0.02);
  EXPECT_DOUBLE_EQ(r.x1[10], std::sin(1.0));
  EXPECT_NEAR(r.u[10], 1.0 + 0.1 * 1.0 / 20.0, 1e-9) << "the next one acts in the last millisecond";
}

TEST(Containers, ADamagedWpilogIsRefusedWithItsPlace) {
  const std::string whole = wpilog();
  const auto refused = [](const std::string& bytes) {
    const TemporaryFile file(bytes, "arm.wpilog");
    return testing::refusal(
        [&] { read_recording(file.path(), columns_named("t", "arm/voltage", "arm/position")); });
  };
  EXPECT_THAT(refused(""), HasSubstr("is empty, expected a recording as WPILOG"));
  EXPECT_THAT(refused("t,u,x1\n0,0,0\n"), HasSubstr("does not begin as a WPILOG"));
  EXPECT_THAT(refused(whole.substr(0, whole.size() - 3)), HasSubstr("bytes left (at byte"));
  std::string other = whole;
  other[7] = 2;
  EXPECT_THAT(refused(other), HasSubstr("is of another version than 1"));
  for (std::size_t at = 0; at < 400; ++at) {
    std::string bytes = whole;
    bytes[at] = static_cast<char>(~bytes[at]);
    refused(bytes);
  }
}

}  // namespace
}  // namespace gapscope
