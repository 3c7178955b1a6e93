#include <cmath>
#include <iterator>

#include "exports/c_header.h"
#include "exports/export.h"
#include "exports/flat.h"
#include "exports/left_out.h"
#include "exports/mjcf.h"
#include "gapscope/base/version.h"

namespace gapscope {
namespace {

using internal::exports::ExportSource;

constexpr ExportFormatSpec kFormats[] = {
    {ExportFormat::kMjcf, "mjcf", "MuJoCo: a complete model and a fragment to include"},
    {ExportFormat::kC, "c",
     "one C99 header without dependencies: the same motion, for a controller or a callback"},
    {ExportFormat::kSdf, "sdf", "Gazebo: one joint with inertia, damping and friction"},
    {ExportFormat::kUrdf, "urdf", "ROS and many others: the same"},
    {ExportFormat::kIsaac, "isaac",
     "Isaac Lab: an actuator configuration (Python), the same and friction at rest"},
    {ExportFormat::kBam, "bam",
     "BAM and Newton: a friction model (JSON), with Stribeck and load-dependent friction"},
};

/// In the order of kFormats.
constexpr DriveExport (*kExporters[])(const ExportSource&) = {
    internal::exports::export_mjcf, internal::exports::export_c,     internal::exports::export_sdf,
    internal::exports::export_urdf, internal::exports::export_isaac, internal::exports::export_bam};
static_assert(std::size(kExporters) == std::size(kFormats));

}  // namespace

std::span<const ExportFormatSpec> export_formats() { return kFormats; }

DriveExport export_drive(const Configuration& configuration, ExportFormat format,
                         const std::optional<JointNumbers>& own) {
  ExportSource source = internal::exports::export_source(configuration);
  source.own = own;
  DriveExport out = kExporters[static_cast<std::size_t>(format)](source);
  Certificate& c = out.certificate;
  c.name = source.name;
  c.version = version();
  c.coordinates = source.coordinates;
  c.input = source.input;
  if (std::isnan(c.duration)) c.duration = source.duration();
  c.encoder_floor = source.encoder_floor;
  c.configuration = source.configuration;
  if (source.commanded) internal::exports::tell_controller(source, c);
  internal::exports::warn_of_left_out(source, c);
  for (const ExportedFile& file : out.files) c.files.push_back(file.name);
  return out;
}

DriveExport export_drive(const std::string& configuration_file, ExportFormat format) {
  return export_drive(load_configuration(configuration_file), format);
}

}  // namespace gapscope
