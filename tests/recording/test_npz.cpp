// Recordings as NumPy writes them: tests/recording/files/make_arrays.py made the files.
#include "recording/array_fixture.h"

namespace gapscope {
namespace {

using testing::columns_named;
using ::testing::HasSubstr;
using testing::put;
using testing::written_file;

class NumpyFile : public ::testing::TestWithParam<const char*> {
 protected:
  Recording read(const std::string& input, const std::string& position) const {
    return read_recording(written_file(GetParam()), columns_named("t", input, position));
  }
};

TEST_P(NumpyFile, GivesItsArraysAsColumns) {
  const Recording r = read_recording(written_file(GetParam()));
  ASSERT_EQ(r.size(), 60u);
  EXPECT_DOUBLE_EQ(r.dt, 1e-3);
  EXPECT_EQ(r.u[7], 3.5);
  EXPECT_EQ(r.x1[3], 0.03);
  EXPECT_EQ(r.file, GetParam());
}

TEST_P(NumpyFile, TakesAnyTypeAndOrder) {
  EXPECT_EQ(read("big", "counts").x1[0], -30.0);
  EXPECT_EQ(read("big", "counts").u[59], 29.5);
  EXPECT_EQ(read("half", "upright").u[59], 29.5);
  EXPECT_EQ(read("half", "upright").x1[59], 0.59);
  EXPECT_EQ(read("on", "x1").u[2], 1.0);
}

TEST_P(NumpyFile, TakesAColumnOfATable) {
  for (const char* second : {"q[:, 1]", "q[:,1]", "q(:,2)", "q_columns[:, 1]"})
    EXPECT_EQ(read("u", second).x1[5], -10.0) << second;
  EXPECT_EQ(read("u", "q_columns[:, 0]").x1[5], 0.05);
}

INSTANTIATE_TEST_SUITE_P(Of, NumpyFile, ::testing::Values("drive.npz", "drive_deflated.npz"),
                         [](const auto& tested) { return tested.index == 0 ? "Stored" : "Deflated"; });

TEST(Npz, RefusesWhatIsNoVectorOfRealNumbersWithWhatToDo) {
  const auto tried = [](const std::string& position) {
    return testing::refusal(
        [&] { read_recording(written_file("drive_deflated.npz"), columns_named("t", "u", position)); });
  };
  EXPECT_THAT(tried("theta"), HasSubstr("there is no array 'theta', expected it beside those that are there: "
                                        "'big', 'broken', 'complex', "));
  EXPECT_THAT(tried("q"),
              HasSubstr("the array 'q' is of size 60 x 2, expected a vector of real numbers (one of "
                        "its columns is q[:, 0])"));
  EXPECT_THAT(tried("q[:, 2]"), HasSubstr("it has no column 'q[:, 2]'"));
  EXPECT_THAT(tried("q(:, 0)"), HasSubstr("there is no array 'q(:, 0)'"));
  EXPECT_THAT(tried("complex"), HasSubstr("is complex, expected a vector of real numbers (save its .real)"));
  EXPECT_THAT(tried("objects"), HasSubstr("holds objects of Python, expected a vector"));
  EXPECT_THAT(tried("dates"), HasSubstr("holds dates"));
  EXPECT_THAT(tried("text"), HasSubstr("is a text"));
  EXPECT_THAT(tried("fields"), HasSubstr("(save each field: numpy.savez("));
  EXPECT_THAT(tried("wide"), HasSubstr("has numbers of another width"));
  EXPECT_THAT(tried("short"), HasSubstr("the array 'short' has 50 values, expected 60 as in 't'"));
  EXPECT_EQ(tried("broken"), "") << "one number that is none is drawn over";
}

/// Where a member's own header begins, and its entry in the directory.
std::size_t local_of(const std::string& bytes, const std::string& name) {
  return bytes.find(name + ".npy") - 30;
}
std::size_t entry_of(const std::string& bytes, const std::string& name) {
  return bytes.rfind(name + ".npy") - 46;
}
std::size_t end_of(const std::string& bytes) { return bytes.rfind("PK\5\6"); }
std::size_t array_of(const std::string& bytes) { return bytes.find("\x93NUMPY", local_of(bytes, "x1")); }

void replace_in_x1(std::string& bytes, const std::string& from, const std::string& to) {
  bytes.replace(bytes.find(from, array_of(bytes)), from.size(), to);
}

TEST(Npz, RefusesAMalformedFileWithPlaceAndRemedy) {
  const std::string again = "expected a whole .npz, as numpy.savez or savez_compressed writes it";
  const std::vector<testing::Malformed> cases = {
      {"empty", [](auto& b) { b.clear(); }, {"is empty, expected a recording as"}},
      {"text", [](auto& b) { b = "t,u,x1\n0,0,0\n"; }, {"it has no directory at its end", again}},
      {"half", [](auto& b) { b.resize(b.size() / 2); }, {"is cut off", again}},
      {"without its last byte", [](auto& b) { b.pop_back(); }, {"is cut off", again}},
      {"more entries", [](auto& b) { put(b, end_of(b) + 10, 40, 2); }, {"at byte", "no entry", again}},
      {"many entries", [](auto& b) { put(b, end_of(b) + 12, 0xf0000000, 4); }, {"a directory of", again}},
      {"directory beyond",
       [](auto& b) { put(b, end_of(b) + 16, 0x7000000, 4); },
       {"at byte 117440512", again}},
      {"directory elsewhere", [](auto& b) { put(b, end_of(b) + 16, 7, 4); }, {"damaged at byte 7", again}},
      {"no entry", [](auto& b) { b[entry_of(b, "x1")] = 'X'; }, {"damaged at byte", again}},
      {"long name", [](auto& b) { put(b, entry_of(b, "x1") + 28, 65535, 2); }, {"damaged at byte", again}},
      {"no member",
       [](auto& b) { b[local_of(b, "x1")] = 'X'; },
       {"'x1' (at byte", "no member is there", again}},
      {"member beyond",
       [](auto& b) { put(b, entry_of(b, "x1") + 42, 1u << 30, 4); },
       {"'x1' (at byte 10737"}},
      {"long local name", [](auto& b) { put(b, local_of(b, "x1") + 26, 65535, 2); }, {"'x1' (at", "cut off"}},
      {"packed beyond",
       [](auto& b) { put(b, entry_of(b, "x1") + 20, 1u << 31, 4); },
       {"'x1' (at", "cut off"}},
      {"fewer bytes",
       [](auto& b) { put(b, entry_of(b, "x1") + 20, 300, 4); },
       {"ends after", "of 60 numbers"}},
      {"encrypted", [](auto& b) { put(b, entry_of(b, "x1") + 8, 1, 2); }, {"'x1' is encrypted"}},
      {"bzip2", [](auto& b) { put(b, entry_of(b, "x1") + 10, 12, 2); }, {"'x1' is compressed by method 12"}},
      {"no deflated bytes",
       [](auto& b) { put(b, entry_of(b, "x1") + 10, 8, 2); },
       {"'x1' (at", "does not begin"}},
      {"another number", [](auto& b) { b[array_of(b) + 200] ^= 1; }, {"'x1' (at", "its checksum", again}},
      {"no array", [](auto& b) { b[array_of(b)] = 'X'; }, {"'x1' (at", "does not begin as an array", again}},
      {"version 9", [](auto& b) { b[array_of(b) + 6] = 9; }, {"'x1' (at", "does not begin", again}},
      {"long header",
       [](auto& b) { put(b, array_of(b) + 8, 65535, 2); },
       {"'x1' (at", "does not begin", again}},
      {"more numbers", [](auto& b) { replace_in_x1(b, "(60,), }  ", "(6000,), }"); }, {"of 6000 numbers"}},
      {"fewer numbers",
       [](auto& b) { replace_in_x1(b, "(60,)", "(06,)"); },
       {"'x1' (at", "more bytes than", again}},
      {"far too many",
       [](auto& b) { replace_in_x1(b, "(60,), }       ", "(99999999999,)}"); },
       {"more than 20000000"}},
      {"unheard of",
       [](auto& b) { replace_in_x1(b, "(60,), }" + std::string(13, ' '), "(9999999999999999999)"); },
       {"'x1'"}},
      {"no shape", [](auto& b) { replace_in_x1(b, "'shape'", "'shade'"); }, {"does not begin", again}},
      {"no type", [](auto& b) { replace_in_x1(b, "'descr'", "'desk' "); }, {"does not begin", again}},
  };
  testing::expect_refused(written_file("drive.npz"), ".npz", {}, cases);
}

TEST(Npz, OtherKindsAreRefusedWithHowToConvert) {
  for (const auto& [ending, said] : {std::pair{".npy", "numpy.savez("},
                                     {".bag", "rosbags-convert"},
                                     {".parquet", "to_csv("},
                                     {".xlsx", "save the sheet as CSV"}}) {
    const testing::TemporaryFile file("x", std::string("r") + ending);
    EXPECT_THAT(testing::refusal([&] { read_recording(file.path()); }), HasSubstr(said));
  }
}

}  // namespace
}  // namespace gapscope
