#include "diagnosis/remedies.h"

namespace gapscope::internal::diagnosis {

const std::map<std::string, std::string>& remedies() {
  static const std::string diagnose =
      "Run `gapscope diagnose CONFIG`: it finds what the model still lacks, such as a delay, cogging or "
      "another friction law.";
  static const std::string without =
      "Fit the model with its gap closed (`--set model.parameters.gap=0`, a compliant shaft) or as one body "
      "(`gapscope init --model one_body`), or record a motion that closes the contact on both sides.";
  static const std::string record = "Record a motion that closes the contact on both sides, several times.";
  static const std::string nearer = "Start the fit nearer to the drive (model: parameters), ";
  static const std::map<std::string, std::string> all = {
      {"leaves_unexplained", diagnose},
      {"above_floor", diagnose},
      {"residual_patterned", diagnose},
      {"parts_disagree", diagnose},
      {"as_well_without_gap", without},
      {"gap_bears_little", diagnose},
      {"gap_differs", without},
      {"odd_coupling", diagnose},
      {"gap_at_bound", without},
      {"gap_not_determined", record},
      {"not_settled", nearer + "or raise fit: max_iterations."},
      {"failed", nearer + "and check the unit of u."}};
  return all;
}

}  // namespace gapscope::internal::diagnosis
