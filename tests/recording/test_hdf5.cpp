// Recordings as h5py writes them: tests/recording/files/make_arrays.py made the file.
#include <cstring>

#include "recording/array_fixture.h"

namespace gapscope {
namespace {

using testing::columns_named;
using ::testing::HasSubstr;
using testing::written_file;

Recording read_h5(const std::string& input, const std::string& position) {
  return read_recording(written_file("drive.h5"), columns_named("t", input, position));
}

TEST(Hdf5, GivesItsDatasetsAsColumns) {
  const Recording r = read_h5("u", "robot/arm/x1");
  ASSERT_EQ(r.size(), 60u);
  EXPECT_DOUBLE_EQ(r.dt, 1e-3);
  EXPECT_EQ(r.u[7], 3.5);
  EXPECT_EQ(r.x1[3], 0.03);
  EXPECT_EQ(r.file, "drive.h5");
}

TEST(Hdf5, TakesAnyTypeAndAColumnOfATable) {
  EXPECT_EQ(read_h5("big", "counts").x1[0], -30.0);
  EXPECT_EQ(read_h5("half", "upright").u[59], 29.5);
  EXPECT_EQ(read_h5("u", "q[:, 1]").x1[5], -10.0);
}

TEST(Hdf5, RefusesWhatIsNoVectorOfRealNumbersWithWhatToDo) {
  const auto tried = [](const std::string& position) {
    return testing::refusal([&] { read_h5("u", position); });
  };
  EXPECT_THAT(tried("theta"),
              HasSubstr("drive.h5: there is no dataset 'theta', expected it beside those that are there: "));
  EXPECT_THAT(tried("theta"), HasSubstr("'robot/arm/x1'"));
  EXPECT_THAT(tried("robot/arm"), HasSubstr("there is no dataset 'robot/arm'"));
  EXPECT_THAT(
      tried("q"),
      HasSubstr("'q' is of size 60 x 2, expected a vector of real numbers (one of its columns is q[:, 0])"));
  EXPECT_THAT(tried("q[:, 2]"), HasSubstr("it has no column 'q[:, 2]'"));
  EXPECT_THAT(tried("chunk"), HasSubstr("is of size 60 x 4 x 4"));
  EXPECT_THAT(tried("complex"), HasSubstr("has fields of its own"));
  EXPECT_THAT(tried("fields"), HasSubstr("(write a dataset for each field)"));
  EXPECT_THAT(tried("text"), HasSubstr("is a text"));
  EXPECT_THAT(tried("short"), HasSubstr("the dataset 'short' has 50 values, expected 60 as in 't'"));
  EXPECT_EQ(tried("broken"), "") << "one number that is none is drawn over";
}

/// Where the numbers of a column stand that is stored in one piece.
std::size_t numbers_of(const std::string& bytes, double first, double second) {
  std::string both(16, '\0');
  std::memcpy(both.data(), &first, 8);
  std::memcpy(both.data() + 8, &second, 8);
  return bytes.find(both);
}

TEST(Hdf5, RefusesAMalformedFileWithPlaceAndRemedy) {
  const std::string whole = "expected a whole file of that format (h5clear -s FILE";
  const auto zeros = [](std::size_t from, std::size_t count) {
    return [=](std::string& b) { std::fill_n(b.begin() + static_cast<std::ptrdiff_t>(from), count, '\0'); };
  };
  const auto number = [](double value) {
    return [=](std::string& b) { std::memcpy(b.data() + numbers_of(b, 0.0, 0.001) + 24, &value, 8); };
  };
  const std::vector<testing::Malformed> cases = {
      {"empty", [](auto& b) { b.clear(); }, {"is empty, expected a recording as"}},
      {"text", [](auto& b) { b = "t,u,x1\n0,0,0\n"; }, {whole}},
      {"half", [](auto& b) { b.resize(b.size() / 2); }, {whole}},
      {"only a start", [](auto& b) { b.resize(96); }, {whole}},
      {"without its last byte", [](auto& b) { b.pop_back(); }, {whole}},
      {"another signature", [](auto& b) { b[1] = 'X'; }, {whole}},
      {"version 9 of the superblock", [](auto& b) { b[8] = 9; }, {whole}},
      {"no sizes of offsets", zeros(13, 2), {whole}},
      {"no end of the file", zeros(40, 8), {whole}},
      {"no root", zeros(56, 40), {"there is no dataset 't'"}},
      {"no first header", zeros(96, 40), {whole}},
      {"a late time", number(9.0), {"sample 5: t goes from 9 to 0.004 s, expected time that increases"}},
      {"no time", number(std::nan("")), {"sample 5: time is not uniform"}},
      {"an endless time", number(HUGE_VAL), {"sample 4: t is inf, expected a finite number"}},
      {"another step", number(0.0035), {"sample 4: time is not uniform", "resample: {rate: ...}"}},
  };
  testing::expect_refused(written_file("drive.h5"), ".h5", {}, cases);
}

TEST(Hdf5, DamagedBytesAreRefusedOrReadNeverTheEnd) {
  const std::string good = testing::text_of(written_file("drive.h5"));
  for (std::size_t at = 97; at < good.size(); at += 4201) {
    std::string bytes = good;
    for (std::size_t i = at; i < std::min(at + 8, bytes.size()); ++i) bytes[i] = static_cast<char>(~bytes[i]);
    const testing::TemporaryFile file(bytes, "r.h5");
    EXPECT_NO_THROW(testing::refusal([&] {
      read_recording(file.path(), columns_named("t", "u", "robot/arm/x1"));
    })) << at;
  }
}

}  // namespace
}  // namespace gapscope
