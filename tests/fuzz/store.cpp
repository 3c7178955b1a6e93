#include "campaign/store.h"

#include <sqlite3.h>

#include <sstream>
#include <vector>

#include "campaign/small_campaign.h"
#include "campaign/summary.h"
#include "fuzz/attempt.h"
#include "fuzz/readers.h"
#include "support/reading.h"

namespace gapscope::testing {
namespace {

/// A store of two runs with a listed axis, a range and a number that is drawn.
std::string good_store() {
  const SmallCampaign small(
      "sampling: {latin_hypercube: {samples: 2}}\n"
      "axes: {encoder.bits: [16, 18], simulation.rate: {range: [500, 1000]}}\n"
      "drawn: {simulation.noise: {uniform: [0, 1.0e-5]}}\n");
  {
    CampaignStore store(small.place("store"), campaign_header(small.config, {}));
    for (std::uint64_t run = 0; run < 2; ++run) {
      CampaignRow row;
      row.run = run;
      for (const AxisValue& value : campaign_point(small.config, run)) row.point.push_back(value.yaml);
      row.model_free.gap = row.true_gap = 0.019;
      row.model_free.outcome = run == 0 ? "backlash" : "inconclusive";
      row.model_free.answers = run == 0;
      row.model_free.ci95 = {0.018, 0.02};
      store.add(row, {});
    }
  }
  return text_of(small.place("store/results.sqlite"));
}

/// Changes one cell after the other of a good store, as the lines say; an empty line leaves its cell.
void write_cells(const std::string& file, std::string_view lines) {
  static const std::vector<const char*> cells = {
      "UPDATE campaign SET value = ?1 WHERE key = 'version'",
      "UPDATE campaign SET value = ?1 WHERE key = 'name'",
      "UPDATE campaign SET value = ?1 WHERE key = 'identity'",
      "UPDATE campaign SET value = ?1 WHERE key = 'coordinates'",
      "UPDATE campaign SET value = ?1 WHERE key = 'estimators'",
      "UPDATE campaign SET value = ?1 WHERE key = 'runs'",
      "UPDATE campaign SET value = ?1 WHERE key = 'shard'",
      "UPDATE campaign SET value = ?1 WHERE key = 'shards'",
      "UPDATE axes SET kind = ?1 WHERE path = 'encoder.bits'",
      "UPDATE axes SET listed = ?1 WHERE path = 'encoder.bits'",
      "UPDATE axes SET count = ?1",
      "UPDATE axes SET low = ?1",
      "UPDATE axes SET high = ?1",
      "UPDATE axes SET logarithmic = ?1",
      "UPDATE runs SET run = ?1 WHERE run = 0",
      "UPDATE runs SET \"encoder.bits\" = ?1 WHERE run = 1",
      "UPDATE runs SET \"simulation.rate\" = ?1",
      "UPDATE runs SET model_free_gap_rad = iif(?1 GLOB '[-+0-9.]*', ?1 + 0, ?1)",
      "UPDATE runs SET true_gap_rad = iif(?1 GLOB '[-+0-9.]*', ?1 + 0, ?1)",
      "UPDATE runs SET model_free_verdict = ?1",
      "UPDATE runs SET agree = iif(?1 GLOB '[-+0-9.]*', ?1 + 0, ?1)",
      "UPDATE runs SET error = ?1 WHERE run = 1"};
  sqlite3* database = nullptr;
  require(sqlite3_open(file.c_str(), &database) == SQLITE_OK, "no store");
  sqlite3_exec(database, "PRAGMA synchronous = OFF; PRAGMA journal_mode = MEMORY; BEGIN", nullptr, nullptr,
               nullptr);
  std::istringstream in{std::string(lines)};
  std::string line;
  for (std::size_t i = 0; i < cells.size() && std::getline(in, line); ++i) {
    if (line.empty()) continue;
    sqlite3_stmt* update = nullptr;
    sqlite3_prepare_v2(database, cells[i], -1, &update, nullptr);
    sqlite3_bind_text(update, 1, line.data(), static_cast<int>(line.size()), SQLITE_TRANSIENT);
    sqlite3_step(update);
    sqlite3_finalize(update);
  }
  sqlite3_exec(database, "COMMIT", nullptr, nullptr, nullptr);
  sqlite3_close(database);
}

}  // namespace

int read_store(std::string_view bytes) {
  static const std::string good = good_store();
  static const GivenFile file("results.sqlite");
  const bool is_database = bytes.starts_with("SQLite format");
  for (const char* beside : {"-wal", "-shm", "-journal"}) std::filesystem::remove(file.path() + beside);
  file.fill(is_database ? bytes : std::string_view(good));
  if (!is_database) write_cells(file.path(), bytes);
  int taken = attempt([&] { SmallCampaign::exported(CampaignStore(file.folder())); });
  taken += attempt([&] { summarise(CampaignStore(file.folder())); });
  static const ScratchFolder merged;
  const std::filesystem::path whole = merged.path / "whole";
  std::filesystem::remove_all(whole);
  return taken + attempt([&] { merge_campaigns({file.folder(), file.folder()}, whole.string()); });
}

}  // namespace gapscope::testing
