// A recording of several axes: one is named, all are found.
#include "recording/array_fixture.h"
#include "recording/axes.h"

namespace gapscope {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::TemporaryFile;
using testing::written_file;

RecordingColumns named(const std::string& position, const std::string& input = "u") {
  return testing::columns_named("t", input, position).columns;
}

TEST(Axes, AreFoundByTheNameOfThePosition) {
  EXPECT_THAT(recorded_axes(written_file("joints.mcap"), named("{axis}.position")),
              ElementsAre("finger", "elbow", "lamp", "wrist"));
  EXPECT_THAT(recorded_axes(written_file("joints.db3"), named("/joint_states/{axis}.position")),
              ElementsAre("elbow", "lamp", "wrist"));
  EXPECT_THAT(recorded_axes(written_file("drive.npz"), named("q[:, {axis}]")), ElementsAre("0", "1"));
  EXPECT_THAT(recorded_axes(written_file("drive.h5"), named("q(:, {axis})")), ElementsAre("1", "2"));
  const TemporaryFile csv("t; joint10_pos; joint2_pos; joint1_u\n0;0;0;0\n");
  EXPECT_THAT(recorded_axes(csv.path(), named("joint{axis}_pos")), ElementsAre("2", "10"));
}

TEST(Axes, AreNotLookedForInComments) {
  const TemporaryFile csv(
      "# joint7_pos, joint8_pos, of a bench, more, and more\n  # again\nt, joint1_pos\n0, 0\n");
  EXPECT_THAT(recorded_axes(csv.path(), named("joint{axis}_pos")), ElementsAre("1"));
}

TEST(Axes, AreReadOneByOne) {
  ReadOptions options;
  options.columns = columns_of_axis(named("{axis}.position", "{axis}.effort"), "wrist");
  const Recording r = read_recording(written_file("joints.mcap"), options);
  EXPECT_EQ(r.x1[5], -10.0);
  EXPECT_EQ(r.u[5], 3.0);
}

TEST(Axes, ThatCannotBeFoundAreRefusedWithWhatToDo) {
  const auto all = [](const std::string& position) {
    return testing::refusal([&] { recorded_axes(written_file("drive.npz"), named(position)); });
  };
  EXPECT_THAT(all("x1"), HasSubstr("the position is 'x1', expected a name with {axis} in it"));
  EXPECT_THAT(all("{axis}.position"),
              HasSubstr("has 0 columns named as '{axis}.position', expected 1 to 100"));
  EXPECT_THAT(testing::refusal([] { recorded_axes(written_file("wide.npz"), named("q[:, {axis}]")); }),
              HasSubstr("has 101 columns named as 'q[:, {axis}]', expected 1 to 100"));
  ReadOptions options;
  options.columns = named("q[:, {axis}]");
  EXPECT_THAT(testing::refusal([&] { read_recording(written_file("drive.npz"), options); }),
              HasSubstr("has several axes: {axis} is in the names of its columns, expected --axis NAME"));
}

}  // namespace
}  // namespace gapscope
