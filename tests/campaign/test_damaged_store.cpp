// A store that is damaged, of something else or contradicts itself is refused by name, and not written to.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "base/interrupt.h"
#include "campaign/change_store.h"
#include "campaign/small_campaign.h"
#include "campaign/summary.h"
#include "gapscope/base/errors.h"
#include "support/reading.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;
using testing::SmallCampaign;

struct Damage {
  const char* name;
  const char* sql;    ///< what is done to a good store; "": its file is replaced
  const char* bytes;  ///< by these
  const char* message;
};

void PrintTo(const Damage& damage, std::ostream* out) { *out << damage.name; }

class DamagedStoreTest : public ::testing::TestWithParam<Damage> {};

TEST_P(DamagedStoreTest, IsRefusedByName) {
  const SmallCampaign small("axes: {encoder.bits: [16, 18]}\n");
  { CampaignStore(small.place("store"), campaign_header(small.config, {})); }
  const std::string file = small.place("store/results.sqlite");
  if (*GetParam().sql != '\0')
    testing::change_store(file, GetParam().sql);
  else
    std::ofstream(file, std::ios::binary) << GetParam().bytes;
  const std::string before = testing::text_of(file);
  const std::string read = testing::refusal([&] {
    const CampaignStore store(small.place("store"));
    SmallCampaign::exported(store);
    summarise(store);
  });
  EXPECT_THAT(read, HasSubstr("store/results.sqlite: " + std::string(GetParam().message)));
  EXPECT_THAT(read, HasSubstr(", expected "));
  EXPECT_EQ(testing::text_of(file), before);
}

const std::vector<Damage> kDamages = {
    {"text", "", "run,gap\n1,0.01\n and so on, long enough to be no header of a database at all, but words\n",
     "is damaged or no store (file is not a database)"},
    {"empty", "", "", "holds no campaign"},
    {"another_database", "DROP TABLE campaign", "", "holds no campaign"},
    {"other_schema", "UPDATE campaign SET value = 'gapscope.campaign/9' WHERE key = 'schema'", "",
     "has the schema 'gapscope.campaign/9', expected 'gapscope.campaign/2'"},
    {"no_schema", "DELETE FROM campaign WHERE key = 'schema'", "", "has no schema"},
    {"no_version", "DELETE FROM campaign WHERE key = 'version'", "", "has no version"},
    {"no_identity", "DELETE FROM campaign WHERE key = 'identity'", "", "has no identity"},
    {"runs_word", "UPDATE campaign SET value = 'many' WHERE key = 'runs'", "",
     "runs is 'many', expected a whole number from 1 to 10000000"},
    {"runs_negative", "UPDATE campaign SET value = '-3' WHERE key = 'runs'", "", "runs is '-3'"},
    {"runs_null", "UPDATE campaign SET value = NULL WHERE key = 'runs'", "", "runs is ''"},
    {"runs_beyond", "UPDATE campaign SET value = '99999999999999999999999' WHERE key = 'runs'", "",
     "runs is '99999999999999999999999'"},
    {"shards_none", "UPDATE campaign SET value = '0' WHERE key = 'shards'", "", "shards is '0'"},
    {"shard_beyond", "UPDATE campaign SET value = '5' WHERE key = 'shard'", "", "holds shard 5/1"},
    {"no_axes", "DROP TABLE axes", "", "is damaged or no store (no such table: axes)"},
    {"no_runs", "DROP TABLE runs", "", "is damaged or no store (no such table: runs)"},
    {"other_axis", "UPDATE axes SET path = 'encoder.bats'", "", "is damaged or no store (no such column"},
    {"runs_too_many", "UPDATE campaign SET value = '20000000' WHERE key = 'runs'", "",
     "runs is '20000000', expected a whole number from 1 to 10000000"},
    {"control_characters", "UPDATE campaign SET value = 'a' || char(27) || 'b' WHERE key = 'schema'", "",
     "is damaged (a cell holds no text)"},
    {"text_for_a_number",
     "INSERT INTO runs (run, \"encoder.bits\", model_free_gap_rad) VALUES (0, '16', 'abc')", "",
     "is damaged (a cell holds no number)"},
    {"axis_without_values", "UPDATE axes SET count = 0", "",
     "the axis 'encoder.bits' has neither values nor a range"},
    {"run_beyond", "INSERT INTO runs (run, \"encoder.bits\") VALUES (7, '16')", "",
     "holds run 7, expected 0 to 1"},
    {"run_negative", "INSERT INTO runs (run, \"encoder.bits\") VALUES (-1, '16')", "", "holds run -1"},
    {"value_of_no_axis", "INSERT INTO runs (run, \"encoder.bits\") VALUES (0, '17')", "",
     "run 0 has the value '17' of 'encoder.bits'"},
    {"view_for_runs",
     "ALTER TABLE runs RENAME TO before; CREATE VIEW runs AS WITH RECURSIVE w(run) AS (SELECT 0 UNION ALL "
     "SELECT run FROM w) SELECT * FROM w JOIN before",
     "", "has the view 'runs' beside its tables"},
    {"trigger", "CREATE TRIGGER e AFTER INSERT ON runs BEGIN UPDATE runs SET model_free_gap_rad = 0.5; END",
     "", "has the trigger 'e' beside its tables"},
    {"no_timing", "DROP TABLE timing", "", "is damaged or no store (no such table: timing)"},
};

INSTANTIATE_TEST_SUITE_P(Store, DamagedStoreTest, ::testing::ValuesIn(kDamages),
                         [](const auto& tested) { return std::string(tested.param.name); });

TEST(DamagedStore, ATriggerIsRefusedBeforeARowIsAddedToo) {
  const SmallCampaign small("axes: {encoder.bits: [16, 18]}\n");
  { CampaignStore(small.place("store"), campaign_header(small.config, {})); }
  testing::change_store(
      small.place("store/results.sqlite"),
      "CREATE TRIGGER e AFTER INSERT ON runs BEGIN UPDATE runs SET model_free_gap_rad = 0.5; END");
  EXPECT_THAT(testing::refusal([&] { small.run("store", 1); }),
              HasSubstr("has the trigger 'e' beside its tables"));
}

TEST(DamagedStore, ALostRunIsMadeAgainThoughItsTimeIsStillThere) {
  const SmallCampaign small("axes: {encoder.bits: [16, 18]}\n");
  small.run("store", 1);
  const auto exported = [&] { return SmallCampaign::exported(CampaignStore(small.place("store"))); };
  const auto whole = exported();
  testing::change_store(small.place("store/results.sqlite"), "DELETE FROM runs WHERE run = 1");
  ASSERT_NE(exported(), whole);
  small.run("store", 1);
  EXPECT_EQ(exported(), whole);
}

TEST(DamagedStore, ReadingItEndsWhenItIsAskedTo) {
  const SmallCampaign small("axes: {encoder.bits: [16, 18]}\n");
  small.run("store", 1);
  const CampaignStore store(small.place("store"));
  int rows = 0;
  const auto read = [&] { store.each([&](CampaignRow&, const CampaignTiming&) { ++rows, request_stop(); }); };
  EXPECT_THROW(read(), Interrupted);
  EXPECT_EQ(rows, 1);
  clear_stop_request();
}

TEST(DamagedStore, NothingIsExportedOfADamagedOne) {
  const SmallCampaign small("axes: {encoder.bits: [16, 18]}\n");
  small.run("store", 1);
  testing::change_store(small.place("store/results.sqlite"),
                        "UPDATE runs SET model_free_verdict = CAST(x'ff00a5' AS TEXT) WHERE run = 1");
  std::string told;
  EXPECT_THAT(testing::refusal([&] {
                export_campaign(CampaignStore(small.place("store")), false,
                                [&](const std::string& t) { told += t; });
              }),
              HasSubstr("results.sqlite: is damaged (a cell holds no text)"));
  EXPECT_EQ(told, "") << "not a row of it";
}

TEST(DamagedStore, ADatabaseOfSomethingElseIsNotWrittenTo) {
  const SmallCampaign small("axes: {encoder.bits: [16, 18]}\n");
  std::filesystem::create_directory(small.place("store"));
  const std::string file = small.place("store/results.sqlite");
  testing::change_store(file, "CREATE TABLE photographs (name TEXT)");
  const std::string before = testing::text_of(file);
  EXPECT_THAT(
      testing::refusal([&] { CampaignStore(small.place("store"), campaign_header(small.config, {})); }),
      HasSubstr("results.sqlite: holds no campaign"));
  EXPECT_EQ(testing::text_of(file), before);
}

TEST(DamagedStore, PagesThatWereOverwrittenAreToldAsDamage) {
  const SmallCampaign small("axes: {encoder.bits: [16, 18]}\n");
  small.run("store", 1);
  const std::string file = small.place("store/results.sqlite");
  std::string bytes = testing::text_of(file);
  ASSERT_GT(bytes.size(), 8192u);
  std::fill(bytes.begin() + 4096, bytes.end(), '\xa5');
  std::ofstream(file, std::ios::binary) << bytes;
  EXPECT_THAT(testing::refusal([&] { SmallCampaign::exported(CampaignStore(small.place("store"))); }),
              HasSubstr("results.sqlite: is damaged or no store"));
}

TEST(CampaignStore, LeavesTheDatabaseOfAnotherProgramAsItIs) {
  const SmallCampaign small("axes: {encoder.bits: [16, 18]}\n");
  std::filesystem::create_directory(small.place("store"));
  const std::string file = small.place("store/results.sqlite");
  testing::change_store(file, "CREATE TABLE campaign (id, title); INSERT INTO campaign VALUES (1, 'spring')");
  const std::string before = testing::text_of(file);
  EXPECT_NE(testing::refusal([&] { CampaignStore(small.place("store"), campaign_header(small.config, {})); }),
            "");
  EXPECT_EQ(testing::text_of(file), before);
}

TEST(CampaignStore, TakesNothingIntoANewStoreThatLiesBesideIt) {
  const SmallCampaign small("axes: {encoder.bits: [16, 18]}\n");
  std::filesystem::create_directory(small.place("store"));
  for (const char* end : {"-wal", "-shm", "-journal"}) {
    const std::string file = small.place("store/results.sqlite") + end;
    std::ofstream(file) << "mine";
    EXPECT_THAT(
        testing::refusal([&] { CampaignStore(small.place("store"), campaign_header(small.config, {})); }),
        HasSubstr("is there without the store"));
    EXPECT_EQ(testing::text_of(file), "mine");
    std::filesystem::remove(file);
  }
}

TEST(CampaignStore, LeavesAUsersFileBesideItAlone) {
  const SmallCampaign small("axes: {encoder.bits: [16, 18]}\n");
  { CampaignStore(small.place("store"), campaign_header(small.config, {})); }
  for (const char* end : {"-wal", "-shm", "-journal"}) {
    const std::string file = small.place("store/results.sqlite") + end;
    std::ofstream(file) << "notes of mine";
    EXPECT_THAT(testing::refusal([&] { CampaignStore(small.place("store")); }),
                HasSubstr("is not what SQLite keeps beside a store"));
    EXPECT_EQ(testing::text_of(file), "notes of mine");
    std::filesystem::remove(file);
    std::filesystem::create_directory(file);
    EXPECT_THAT(testing::refusal([&] { CampaignStore(small.place("store")); }),
                HasSubstr("is not what SQLite keeps beside a store"));
    std::filesystem::remove(file);
  }
}

/// What SQLite has made of its index when it is killed, or the disk is full: it begins with three bytes and
/// grows by pages of 4096.
TEST(CampaignStore, GoesOnWhereTheIndexOfTheLogWasOnlyBegun) {
  const SmallCampaign small("axes: {encoder.bits: [16, 18]}\n");
  { CampaignStore(small.place("store"), campaign_header(small.config, {})); }
  for (const std::size_t size : {0, 3, 4096, 8192, 28672, 32768, 36864}) {
    std::ofstream(small.place("store/results.sqlite-shm")) << std::string(size, '\0');
    EXPECT_EQ(testing::refusal(
                  [&] { CampaignStore(small.place("store"), campaign_header(small.config, {})).done(); }),
              "")
        << size;
  }
}

/// As an empty file, and as a database that somebody has begun.
TEST(CampaignStore, TakesADatabaseWithoutTablesForNoStoreOfItsOwn) {
  const SmallCampaign small("axes: {encoder.bits: [16, 18]}\n");
  std::filesystem::create_directory(small.place("store"));
  const std::string file = small.place("store/results.sqlite");
  testing::change_store(file, "PRAGMA user_version = 7");
  const std::string before = testing::text_of(file);
  EXPECT_THAT(
      testing::refusal([&] { CampaignStore(small.place("store"), campaign_header(small.config, {})); }),
      HasSubstr("results.sqlite: holds no campaign"));
  EXPECT_EQ(testing::text_of(file), before);
  std::ofstream(file).close();
  EXPECT_EQ(testing::refusal([&] { CampaignStore(small.place("store"), campaign_header(small.config, {})); }),
            "");
}

TEST(CampaignStore, IsNotChangedWhereItIsRefused) {
  const SmallCampaign small("axes: {encoder.bits: [16, 18]}\n");
  const SmallCampaign other("axes: {encoder.bits: [16, 20]}\n");
  small.run("store", 1);
  const std::string file = small.place("store/results.sqlite");
  testing::change_store(file, "PRAGMA journal_mode = DELETE");
  const std::string before = testing::text_of(file);
  EXPECT_THAT(
      testing::refusal([&] { CampaignStore(small.place("store"), campaign_header(other.config, {})); }),
      HasSubstr("belongs to another campaign"));
  EXPECT_THAT(testing::refusal([&] {
                CampaignStore(small.place("store"), campaign_header(small.config, {1, 2}));
              }),
              HasSubstr("holds shard 1/1"));
  EXPECT_EQ(testing::text_of(file), before);
}

/// A page that belongs to no table: only a look at all of the file tells.
TEST(DamagedStore, IsNotGoneOnWith) {
  const SmallCampaign small("axes: {encoder.bits: [16, 18]}\n");
  small.run("store", 1);
  const std::string file = small.place("store/results.sqlite");
  testing::change_store(file,
                        "CREATE INDEX added ON runs (run); PRAGMA writable_schema = ON; "
                        "DELETE FROM sqlite_master WHERE name = 'added'");
  EXPECT_THAT(testing::refusal([&] { CampaignStore(small.place("store")); }), HasSubstr("is damaged"));
  EXPECT_THAT(
      testing::refusal([&] { CampaignStore(small.place("store"), campaign_header(small.config, {})); }),
      HasSubstr("is damaged"));
}

}  // namespace
}  // namespace gapscope
