// check_drive FILE: whether a recording is good enough to read a gap from; exit status 3 if it is not.
#include <gapscope/base/errors.h>
#include <gapscope/inspection/inspection.h>

#include <cstdio>

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: check_drive FILE (a CSV with columns t [s], u and x1 [rad])\n");
    return 2;
  }
  try {
    gapscope::Inspection seen = gapscope::inspect(argv[1]);
    gapscope::judge_for(gapscope::Purpose::kGap, seen);
    for (const gapscope::Finding& finding : seen.findings)
      if (finding.severity != gapscope::Severity::kFine)
        std::printf("%s: %s: %s -> %s\n", to_string(finding.severity), finding.rule.c_str(),
                    finding.found.c_str(), finding.advice.c_str());
    std::printf("%d samples, encoder step %.3g rad, %s for a gap\n", seen.facts.samples, seen.facts.quantum,
                seen.spoilt() ? "not good enough" : "good enough");
    return seen.spoilt() ? 3 : 0;
  } catch (const gapscope::ConfigError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
