#pragma once

#include <fstream>
#include <string>

#include "campaign/runner.h"
#include "results/scratch_folder.h"
#include "support/paper_model.h"

namespace gapscope::testing {

/// The paper's rig for two seconds at a coarse rate, in a folder of its own.
class SmallCampaign {
 public:
  /// @param variation  the campaign but for its base
  explicit SmallCampaign(const std::string& variation) {
    std::ofstream(folder.path / "base.yaml") << R"(encoder: {bits: 18}
simulation:
  rate: 1000
  duration: 2
  seed: 3
  excitation: {sine: {amplitude: 0.58, frequency: 1}}
  noise: 1.0e-5
model: )" + kPaperModel;
    std::ofstream(folder.path / "c.yaml") << "name: small\nbase: base.yaml\n" << variation;
    config = load_campaign((folder.path / "c.yaml").string());
  }

  std::string place(const std::string& name) const { return (folder.path / name).string(); }

  /// Does the runs of a shard into a store, and gives the export of that.
  std::string run(const std::string& name, int threads, const CampaignShard& shard = {}) const {
    CampaignStore store(place(name), campaign_header(config, shard));
    run_campaign(config, store, threads, [](const CampaignProgress&) {});
    return exported(store);
  }

  static std::string exported(const CampaignStore& store) {
    std::string text;
    export_campaign(store, false, [&](const std::string& part) { text += part; });
    return text;
  }

  ScratchFolder folder;
  CampaignConfig config;
};

}  // namespace gapscope::testing
