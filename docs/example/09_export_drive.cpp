// export_drive CONFIG: the drive of a configuration, such as the fitted.yaml of a report, as a C header with
// a step function, and what the certificate says of it.
#include <gapscope/base/errors.h>
#include <gapscope/exports/export_drive.h>

#include <cstdio>
#include <fstream>

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: export_drive CONFIG (a YAML whose model has every number)\n");
    return 2;
  }
  try {
    const gapscope::DriveExport drive = gapscope::export_drive(argv[1], gapscope::ExportFormat::kC);
    for (const gapscope::ExportedFile& file : drive.files) {
      std::ofstream(file.name) << file.text;
      std::printf("%s: %zu bytes\n", file.name.c_str(), file.text.size());
    }
    for (const gapscope::CarriedPart& part : drive.certificate.parts)
      if (part.fidelity != gapscope::Fidelity::kExact)
        std::printf("not exact: %s: %s\n", part.part.c_str(), part.how.c_str());
    return 0;
  } catch (const gapscope::ConfigError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
