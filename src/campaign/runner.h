#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "campaign/row.h"
#include "campaign/store.h"
#include "config/campaign_config.h"

namespace gapscope {

/// One run: a function of the campaign and the number of the run, but for its wall times. What goes wrong in
/// it is its result.  @throws Interrupted
CampaignRow run_of_campaign(const CampaignConfig& campaign, std::uint64_t run, CampaignTiming& timing);

/// How far a campaign is.
struct CampaignProgress {
  std::uint64_t runs = 0;    ///< of this shard
  std::uint64_t done = 0;    ///< of them, with those of earlier sessions
  std::uint64_t fresh = 0;   ///< of these, done in this session
  std::uint64_t failed = 0;  ///< of the fresh ones
  double elapsed_s = 0.0;    ///< in this session

  double rate() const {
    return elapsed_s > 0.0 ? static_cast<double>(fresh) / elapsed_s : 0.0;
  }  ///< [runs/s]
  double left_s() const { return fresh > 0 ? static_cast<double>(runs - done) / rate() : kNaN; }
};

/// Does every run of the store's shard that it does not have yet, on `threads` threads (0: all cores), each
/// stored as it finishes. `tell` is called before the first run and after every one, by one thread at a time.
/// @throws Interrupted; what was finished is stored
CampaignProgress run_campaign(const CampaignConfig& campaign, CampaignStore& store, int threads,
                              const std::function<void(const CampaignProgress&)>& tell);

/// What a campaign will take on `threads` threads [s], from a few of its runs spread over it.
struct CampaignForecast {
  int measured = 0;     ///< runs that were tried
  double run_s = kNaN;  ///< their mean time
  double total_s = kNaN;
};
CampaignForecast forecast(const CampaignConfig& campaign, const CampaignShard& shard, int threads);

}  // namespace gapscope
