#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "campaign/row.h"
#include "config/campaign_config.h"
#include "gapscope/base/coordinates.h"

namespace gapscope {

/// Part K of N of a campaign: the runs i with i mod N = K − 1. Parts are disjoint and together complete, and
/// each goes through every axis. 1/1 is the whole.
struct CampaignShard {
  std::uint64_t number = 1;  ///< K
  std::uint64_t of = 1;      ///< N

  bool holds(std::uint64_t run) const { return run % of == number - 1; }
  std::uint64_t size(std::uint64_t runs) const { return runs / of + (runs % of >= number ? 1 : 0); }
};
std::string to_string(const CampaignShard& shard);  ///< "2/3"

/// What a store is a store of.
struct CampaignHeader {
  std::string version;   ///< of gapscope
  std::string name;      ///< of the campaign
  std::string identity;  ///< campaign_identity(), and what the recordings are that it reads
  Coordinates coordinates;
  bool literal = false, model_free = true, reference = true;
  std::uint64_t runs = 0;  ///< of the whole campaign
  CampaignShard shard;
  std::vector<CampaignAxis> axes;
  std::vector<std::string> drawn;  ///< paths
};
CampaignHeader campaign_header(const CampaignConfig& campaign, const CampaignShard& shard);

/// FOLDER/results.sqlite: one row per run in `runs`, written as the run finishes; wall times in `timing`;
/// what the campaign is in `campaign` and `axes`. A process that dies loses at most the rows that were not
/// added yet.
class CampaignStore {
 public:
  /// Opens the store of a campaign, or makes a new one, and keeps others from adding to it.
  /// @throws ConfigError naming the difference if it belongs to another campaign, version or shard, or if
  /// another process adds to it; std::runtime_error where it cannot be written.
  CampaignStore(const std::string& folder, const CampaignHeader& header);

  /// Opens a store for reading.  @throws ConfigError if there is none.
  explicit CampaignStore(const std::string& folder);
  ~CampaignStore();

  const CampaignHeader& header() const { return header_; }
  const std::string& file() const;
  std::set<std::uint64_t> done() const;  ///< runs that are there
  /// Every run that is there, in order. Configurations are left out unless asked for.
  void each(const std::function<void(CampaignRow&, CampaignTiming&)>& visit,
            bool configurations = false) const;
  /// Any thread may add.
  void add(CampaignRow row, CampaignTiming timing);

 private:
  struct Connection;
  std::unique_ptr<Connection> connection_;
  CampaignHeader header_;
};

/// The rows as CSV: run, axes, drawn numbers, results; without configurations. Always in the order of the
/// runs.
/// @param times  with the wall times of each run, the only columns that are no function of the campaign
void export_campaign(const CampaignStore& store, bool times,
                     const std::function<void(const std::string&)>& write);

/// All rows of several stores of one campaign in one new store of the whole. Rows that are in two stores must
/// be the same.  @returns how many runs of the campaign are in it
/// @throws ConfigError naming the difference where the stores do not belong together.
std::uint64_t merge_campaigns(const std::vector<std::string>& folders, const std::string& target);

}  // namespace gapscope
