#include "config/configuration.h"

#include "config/blind_config.h"
#include "config/campaign_config.h"
#include "fuzz/attempt.h"
#include "fuzz/readers.h"

namespace gapscope::testing {
namespace {

/// What was understood is told in full: its own text means the same.
void require_round_trip(const Configuration& c) {
  const std::string text = resolved_yaml(c);
  require(resolved_yaml(parse_configuration(text, c.file)) == text, "another configuration:\n" + text);
}

void read_last_run(const CampaignConfig& c) {
  campaign_identity(c);
  attempt([&] { require_round_trip(campaign_run(c, c.runs() - 1)); });
}

}  // namespace

int read_configuration(std::string_view bytes) {
  static const GivenFile file("c.yaml");
  file.fill(bytes);
  int taken = attempt([&] {
    const Configuration c = load_configuration(file.path());
    require_round_trip(c);
    attempt([&] { require_reference_model(c); });
    attempt([&] { require_possible_experiment(c, 1e-3); });
    if (c.detector.from_model) bound_from_model(c);
  });
  taken += attempt([&] { read_last_run(load_campaign(file.path())); });
  return taken + attempt([&] { load_blind_config(file.path()); });
}

}  // namespace gapscope::testing
