// Recordings as .mat: the files are written by matio, those of version 5 read without it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>
#include <sys/resource.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>

#include "gapscope/base/errors.h"
#include "gapscope/recording/recording_file.h"
#include "support/mat_file.h"
#include "support/reading.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;
using testing::MatWriter;
using ::testing::StartsWith;
using testing::TemporaryFile;
using Values = std::vector<double>;

constexpr std::size_t kSamples = 200;

Values ramp(double step, std::size_t count = kSamples) {
  Values values;
  for (std::size_t i = 0; i < count; ++i) values.push_back(step * static_cast<double>(i));
  return values;
}

/// A place for a .mat file.
struct Place {
  TemporaryFile text{"", "r.csv"};
  std::string path = (text.folder() / "r.mat").string();
};

std::string refusal(const Place& place, const ReadOptions& options = {}) {
  const std::string what = testing::refusal([&] { read_recording(place.path, options); });
  return what.substr(std::min(what.size(), place.path.size() - 5));
}

struct Version {
  const char* name;
  mat_ft version;
  matio_compression compression;
};
void PrintTo(const Version& v, std::ostream* out) { *out << v.name; }

class EveryVersion : public ::testing::TestWithParam<Version> {
 protected:
  void write(const std::function<void(MatWriter&)>& content) const {
    MatWriter writer(place_.path, GetParam().version, GetParam().compression);
    content(writer);
  }
  std::string refused(const ReadOptions& options = {}) const { return refusal(place_, options); }
  Place place_;
};

TEST_P(EveryVersion, GivesTheNumbersOfTheSameCsv) {
  Values x1 = ramp(0.01), u = ramp(1.0);
  std::string csv = "t,u,x1\n";
  for (std::size_t i = 0; i < kSamples; ++i)
    csv += std::to_string(0.001 * static_cast<double>(i)) + "," + std::to_string(u[i]) + "," +
           std::to_string(x1[i]) + "\n";
  write([&](MatWriter& w) { w.column("x1", x1).column("t", ramp(0.001)).column("u", u); });
  const TemporaryFile text(csv);
  const Recording mat = read_recording(place_.path), plain = read_recording(text.path());
  EXPECT_EQ(mat.file, "r.mat");
  EXPECT_EQ(mat.u, plain.u);
  EXPECT_EQ(mat.dt, plain.dt);
  for (std::size_t i = 0; i < kSamples; ++i) ASSERT_DOUBLE_EQ(mat.x1[i], plain.x1[i]);
  EXPECT_TRUE(mat.x2.empty());
}

TEST_P(EveryVersion, MapsVariablesOfAnyClassLyingOrStanding) {
  const Values t = ramp(0.001);
  std::vector<std::int32_t> counts;
  std::vector<float> current;
  std::vector<std::uint8_t> load;
  for (std::size_t i = 0; i < kSamples; ++i) {
    counts.push_back(static_cast<std::int32_t>(i) - 100);
    current.push_back(0.5f * static_cast<float>(i));
    load.push_back(static_cast<std::uint8_t>(i / 2));
  }
  const bool old = GetParam().version == MAT_FT_MAT4;  // knows fewer classes
  write([&](MatWriter& w) {
    w.column("time", t).array("i_q", MAT_C_SINGLE, MAT_T_SINGLE, {1, kSamples}, current.data());
    w.array("theta", MAT_C_INT32, MAT_T_INT32, {kSamples, 1}, counts.data());
    if (!old) w.array("x2", MAT_C_UINT8, MAT_T_UINT8, {1, kSamples}, load.data());
  });
  ReadOptions options;
  options.columns.time = "time", options.columns.input = "i_q", options.columns.position = "theta";
  const Recording r = read_recording(place_.path, options);
  EXPECT_EQ(r.x1[3], -97.0);
  EXPECT_EQ(r.u[7], 3.5);
  EXPECT_EQ(r.x2.size(), old ? 0u : kSamples);
}

TEST_P(EveryVersion, RefusesWhatIsNoVectorOfRealNumbersByName) {
  const Values re = ramp(1.0);
  const mat_complex_split_t both = {const_cast<double*>(re.data()), const_cast<double*>(re.data())};
  const auto tried = [&](const std::function<void(MatWriter&)>& put) {
    write([&](MatWriter& w) {
      w.column("t", ramp(0.001)).column("u", ramp(1.0));
      put(w);
    });
    const std::string what = refused();
    EXPECT_THAT(what, HasSubstr("expected")) << what;
    return what;
  };
  EXPECT_THAT(tried([](MatWriter&) {}),
              StartsWith("r.mat: there is no variable 'x1', expected it beside those that are there: "));
  EXPECT_THAT(tried([&](MatWriter& w) {
                w.array("x1", MAT_C_DOUBLE, MAT_T_DOUBLE, {10, 20}, re.data());
              }),
              StartsWith("r.mat: the variable 'x1' is of size 10 x 20, expected a vector"));
  EXPECT_THAT(tried([&](MatWriter& w) { w.column("x1", ramp(1.0, 150)); }),
              StartsWith("r.mat: the variable 'x1' has 150 values, expected 200 as in 't'"));
  EXPECT_THAT(tried([&](MatWriter& w) {
                w.array("x1", MAT_C_DOUBLE, MAT_T_DOUBLE, {kSamples, 1}, &both, MAT_F_COMPLEX);
              }),
              StartsWith("r.mat: the variable 'x1' is complex"));
  EXPECT_THAT(tried([&](MatWriter& w) {
                w.column("x1", [] {
                  Values v = ramp(1.0);
                  v[16] = INFINITY;
                  return v;
                }());
              }),
              StartsWith("r.mat: sample 17: x1 is inf, expected a finite number"));
  if (GetParam().version == MAT_FT_MAT4) return;  // has no others
  EXPECT_THAT(tried([&](MatWriter& w) { w.structure("x1"); }),
              StartsWith("r.mat: the variable 'x1' is a struct"));
  EXPECT_THAT(tried([&](MatWriter& w) {
                w.array("x1", MAT_C_CHAR, MAT_T_UINT8, {1, 5}, "hello");
              }),
              StartsWith("r.mat: the variable 'x1' is a text"));
  EXPECT_THAT(tried([&](MatWriter& w) { w.cell("x1"); }),
              StartsWith("r.mat: the variable 'x1' is a cell array"));
}

TEST_P(EveryVersion, TimeIsJudgedAsThatOfAnyRecording) {
  write([](MatWriter& w) {
    Values t = ramp(0.001);
    t[30] = t[29];
    w.column("t", t).column("u", ramp(1.0)).column("x1", ramp(1.0));
  });
  EXPECT_THAT(refused(),
              StartsWith("r.mat: sample 31: t goes from 0.029 to 0.029 s, expected time that increases"));
}

TEST_P(EveryVersion, AFileThatEndsTooEarlyIsRefusedWhereverItEnds) {
  write([](MatWriter& w) { w.column("t", ramp(0.001)).column("u", ramp(1.0)).column("x1", ramp(0.01)); });
  const std::string whole = testing::text_of(place_.path);
  for (std::size_t kept = 0; kept < whole.size(); kept += 1 + whole.size() / 40) {
    std::ofstream(place_.path, std::ios::binary) << whole.substr(0, kept);
    EXPECT_THAT(refused(), HasSubstr("expected")) << kept << " of " << whole.size() << " bytes";
  }
}

INSTANTIATE_TEST_SUITE_P(Mat, EveryVersion,
                         ::testing::Values(Version{"v4", MAT_FT_MAT4, MAT_COMPRESSION_NONE},
                                           Version{"v5", MAT_FT_MAT5, MAT_COMPRESSION_NONE},
                                           Version{"v5_deflated", MAT_FT_MAT5, MAT_COMPRESSION_ZLIB},
                                           Version{"v7_3", MAT_FT_MAT73, MAT_COMPRESSION_ZLIB}),
                         [](const auto& version) { return std::string(version.param.name); });

/// A file of version 7.3 with t, u and x1, and what is done to it.
template <class Change>
std::string refusal_of_changed(Change change) {
  const testing::TemporaryFile place("", "r.mat");
  std::vector<double> t;
  for (int i = 0; i < 60; ++i) t.push_back(0.001 * i);
  MatWriter(place.path(), MAT_FT_MAT73).column("t", t).column("u", t).column("x1", t);
  const hid_t file = H5Fopen(place.path().c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  change(file);
  H5Fclose(file);
  return testing::refusal([&] { read_recording(place.path()); });
}

TEST(Mat, DataInOtherFilesAreNotFollowed) {
  EXPECT_EQ(refusal_of_changed([](hid_t) {}), "");
  EXPECT_EQ(
      refusal_of_changed([](hid_t file) { H5Lcreate_soft("/x1", file, "y", H5P_DEFAULT, H5P_DEFAULT); }), "");
  EXPECT_THAT(refusal_of_changed([](hid_t file) {
                H5Ldelete(file, "x1", H5P_DEFAULT);
                H5Lcreate_external("/etc/passwd", "/x1", file, "x1", H5P_DEFAULT, H5P_DEFAULT);
              }),
              HasSubstr("keeps data in other files"));
  EXPECT_THAT(refusal_of_changed([](hid_t file) {
                H5Ldelete(file, "x1", H5P_DEFAULT);
                const hsize_t size[2] = {60, 1};
                const hid_t space = H5Screate_simple(2, size, nullptr), made = H5Pcreate(H5P_DATASET_CREATE);
                H5Pset_external(made, "/etc/passwd", 0, 480);
                H5Dclose(H5Dcreate2(file, "x1", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, made, H5P_DEFAULT));
                H5Pclose(made), H5Sclose(space);
              }),
              HasSubstr("keeps data in other files"));
}

TEST(Mat, AVariableThatIsMarkedAsEmptyHasNoNumbers) {
  EXPECT_THAT(refusal_of_changed([](hid_t file) {
                const hid_t space = H5Screate(H5S_SCALAR);
                H5Aclose(H5Acreate_by_name(file, "x1", "MATLAB_empty", H5T_NATIVE_UINT8, space, H5P_DEFAULT,
                                           H5P_DEFAULT, H5P_DEFAULT));
                H5Sclose(space);
              }),
              HasSubstr("'x1' is damaged"));
}

TEST(Mat, AFileOfAnotherKindIsNone) {
  const TemporaryFile text("t,u,x1\n0,0,0\n", "log.MAT");
  const auto what = testing::refusal([&] { read_recording(text.path()); });
  EXPECT_THAT(
      what,
      HasSubstr("log.MAT: is no .mat file that can be read, expected MATLAB's format, version 4, 5 or 7.3"));
  EXPECT_THAT(testing::refusal([&] { read_recording((text.folder() / "none.mat").string()); }),
              HasSubstr("there is no such file, expected a recording as .mat"));
}

/// What a header claims is not believed: 2^32 numbers, names and sizes without end, in a file of a few bytes.
TEST(Mat, AHeaderThatClaimsMoreThanTheFileHoldsTakesNoMemory) {
  Place place;
  {
    MatWriter writer(place.path, MAT_FT_MAT5, MAT_COMPRESSION_NONE);
    writer.structure("s").column("t", ramp(0.001)).column("u", ramp(1.0)).column("x1", ramp(0.01));
  }
  const std::string whole = testing::text_of(place.path);
  rusage before{}, after{};
  getrusage(RUSAGE_SELF, &before);
  for (std::size_t at = 128; at + 4 <= 700; at += 4) {
    for (const std::uint32_t claim : {0x7fffffffu, 0xfffffff8u, 0x10000000u}) {
      std::string damaged = whole;
      std::memcpy(damaged.data() + at, &claim, sizeof claim);
      std::ofstream(place.path, std::ios::binary) << damaged;
      refusal(place);  // or taken, where it was a number
    }
  }
  getrusage(RUSAGE_SELF, &after);
  EXPECT_LT(after.ru_maxrss - before.ru_maxrss, 300'000)
      << "kB";  // one column of the most samples has 160 MB
}

TEST(Mat, NumbersThatWereChangedAfterwardsAreSeenByTheirChecksum) {
  Place place;
  { MatWriter(place.path).column("t", ramp(0.001)).column("u", ramp(1.0)).column("x1", ramp(0.01)); }
  std::string text = testing::text_of(place.path);
  text[text.size() - 20] = static_cast<char>(text[text.size() - 20] ^ 0x10);
  std::ofstream(place.path, std::ios::binary) << text;
  EXPECT_THAT(refusal(place), StartsWith("r.mat: the variable 'x1' is damaged, expected"));
}

}  // namespace
}  // namespace gapscope
