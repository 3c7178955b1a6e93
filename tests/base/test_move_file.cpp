// What may happen to a file between the last look at it and the moment when it is moved.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/syscall.h>

#include <filesystem>
#include <fstream>

#include "base/move_file.h"
#include "support/company.h"
#include "support/reading.h"
#include "support/temporary_file.h"

namespace gapscope {
namespace {

namespace fs = std::filesystem;
using testing::Ended;
using ::testing::HasSubstr;
using testing::in_company;
using testing::text_of;

constexpr const char* kMine = "precious";

/// As an editor saves: under another name first.
void save(const fs::path& path, const std::string& text) {
  const fs::path other = path.parent_path() / "saved";
  std::ofstream(other) << text;
  fs::rename(other, path);
}

void append(const fs::path& path, const std::string& text) { std::ofstream(path, std::ios::app) << text; }

/// How many files of a folder hold a text.
int holding(const fs::path& folder, const std::string& text) {
  int count = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && text_of(entry.path()).find(text) != std::string::npos) ++count;
  return count;
}

class MoveFile : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!testing::company_can_come()) GTEST_SKIP() << "no filter of system calls here";
  }
};

/// A file that is to be replaced by another one.
struct Pair {
  testing::TemporaryFile place;
  fs::path fresh = place.folder() / ".fresh", path = place.path();
  std::string found = content_identity(path);

  explicit Pair(const std::string& name = "r.csv") : place("old", name) { std::ofstream(fresh) << "new"; }
  Ended replaced(const testing::Company& act) const {
    return in_company(act, [&] { replace_file(found, fresh, path); });
  }
  int files() const { return static_cast<int>(std::distance(fs::directory_iterator(place.folder()), {})); }
};

TEST_F(MoveFile, AFileThatIsMovedAwayInTheLastMomentLeavesItsNameToTheNextOne) {
  const Pair pair;
  const Ended ended = pair.replaced([&](int moment, long) {
    if (moment == 1) fs::rename(pair.path, pair.place.folder() / "kept");
    if (moment == 3) save(pair.path, kMine);  // before the next call, whatever that is
    return 0;
  });
  EXPECT_THAT(ended.refusal, HasSubstr("changed meanwhile"));
  EXPECT_EQ(text_of(pair.path), kMine);
  EXPECT_EQ(text_of(pair.place.folder() / "kept"), "old");
  EXPECT_EQ(pair.files(), 2);
}

TEST_F(MoveFile, ADiskThatFailsIsToldAndNothingIsReplaced) {
  const Pair pair;
  const Ended ended = pair.replaced([](int, long call) { return call == SYS_renameat2 ? EIO : 0; });
  EXPECT_THAT(ended.refusal, HasSubstr("cannot be replaced"));
  EXPECT_EQ(text_of(pair.path), "old");
  EXPECT_EQ(pair.files(), 1);
}

TEST_F(MoveFile, TwoFilesThatCameMeanwhileAreBothThereWhateverTheirNameIs) {
  for (const std::string& name : {std::string("r.csv"), std::string(247, 'n') + ".csv"}) {
    const Pair pair(name);
    const Ended ended = pair.replaced([&](int moment, long) {
      if (moment == 1) save(pair.path, "precious 1");
      if (moment == 3) save(pair.path, "precious 2");
      return 0;
    });
    EXPECT_THAT(ended.refusal, HasSubstr("came_meanwhile_"));
    EXPECT_EQ(text_of(pair.path), "precious 1");
    EXPECT_EQ(holding(pair.place.folder(), "precious 2"), 1);
    EXPECT_EQ(pair.files(), 2);
  }
}

TEST_F(MoveFile, NothingThatCameAtAnyMomentIsLost) {
  for (const bool can_exchange : {true, false})
    for (const auto& act : {save, append})
      for (int when = 1, moments = 1; when <= moments; ++when) {
        const Pair pair;
        const Ended ended = pair.replaced([&](int moment, long call) {
          if (moment == when) act(pair.path, kMine);
          return call == SYS_renameat2 && !can_exchange ? EINVAL : 0;
        });
        moments = ended.moments;
        EXPECT_EQ(holding(pair.place.folder(), kMine), 1) << can_exchange << ", moment " << when;
        EXPECT_EQ(pair.files(), 1) << can_exchange << ", moment " << when << ": " << ended.refusal;
      }
}

TEST_F(MoveFile, AFileSystemThatCannotExchangeReplacesToo) {
  const Pair pair;
  const Ended ended = pair.replaced([](int, long call) { return call == SYS_renameat2 ? EINVAL : 0; });
  EXPECT_EQ(ended.refusal, "");
  EXPECT_EQ(text_of(pair.path), "new");
  EXPECT_EQ(pair.files(), 1);
}

TEST_F(MoveFile, OnlyWhatWasFoundIsRemoved) {
  for (const bool knows_flags : {true, false})
    for (int when = 0, moments = 1; when <= moments; ++when) {
      const testing::TemporaryFile place("old");
      const std::string found = content_identity(place.path());
      const Ended ended = in_company(
          [&](int moment, long call) {
            if (moment == when) save(place.path(), kMine);
            return call == SYS_renameat2 && !knows_flags ? EINVAL : 0;
          },
          [&] { remove_file(found, place.path()); });
      moments = ended.moments;
      EXPECT_EQ(holding(place.folder(), kMine), when == 0 ? 0 : 1) << when;
      EXPECT_EQ(holding(place.folder(), "old"), 0) << when;
    }
}

}  // namespace
}  // namespace gapscope
