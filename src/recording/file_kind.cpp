#include "recording/file_kind.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <vector>

#include "gapscope/base/errors.h"
#include "recording/log_file.h"

namespace gapscope::internal::recording {
namespace {

template <std::unique_ptr<ArrayFile> (*open)(const std::string&)>
std::unique_ptr<ArrayFile> opened(const std::string& path, const RecordingColumns&) {
  return open(path);
}

template <std::unique_ptr<MessageLog> (*open)(const std::string&)>
std::unique_ptr<ArrayFile> logged(const std::string& path, const RecordingColumns& columns) {
  return log_columns(path, open(path), columns);
}

constexpr const char* kPandas =
    "in Python: pandas.read_parquet(FILE).to_csv('drive.csv', index=False), or read_feather, read_pickle";
constexpr const char* kTorch =
    "in Python: d = torch.load(FILE); numpy.savez('drive.npz', **{k: v.numpy() for k, v in d.items()})";
constexpr const char* kSheet = "save the sheet as CSV";

const std::vector<FileKind>& kinds() {
  static const std::vector<FileKind> all = {
      {"", "CSV"},
      {".mat", ".mat", opened<open_mat>},
      {".npz", "NumPy's .npz", opened<open_npz>},
      {".h5", "HDF5", opened<open_hdf5>},
      {".hdf5", "HDF5", opened<open_hdf5>},
      {".hdf", "HDF5", opened<open_hdf5>},
      {".mcap", "MCAP", logged<open_mcap_log>},
      {".db3", "a bag of ROS 2", logged<open_rosbag_log>},
      {".json", "JSON", open_json},
      {".jsonl", "JSON", open_json},
      {".ndjson", "JSON", open_json},
      {".wpilog", "WPILOG", opened<open_wpilog>},
      {".npy", "a single array of NumPy", nullptr,
       "in Python: numpy.savez('drive.npz', t=t, u=u, x1=x1), an array for each column"},
      {".bag", "a bag of ROS 1", nullptr,
       "rosbags-convert --src FILE --dst DIR, which writes a bag of ROS 2"},
      {".parquet", "Parquet", nullptr, kPandas},
      {".hoot", "a log of CTRE", nullptr, "owlet -f wpilog FILE drive.wpilog"},
      {".pt", "a file of PyTorch", nullptr, kTorch},
      {".pth", "a file of PyTorch", nullptr, kTorch},
      {".feather", "Feather", nullptr, kPandas},
      {".pkl", "a pickle of Python", nullptr, kPandas},
      {".xlsx", "a workbook", nullptr, kSheet},
      {".xls", "a workbook", nullptr, kSheet},
      {".ods", "a workbook", nullptr, kSheet},
      {".ulg", "a log of PX4", nullptr, "ulog2csv FILE"},
      {".tdms", "TDMS", nullptr, "in Python: nptdms.TdmsFile.read(FILE).as_dataframe().to_csv('drive.csv')"},
      {".mf4", "MDF", nullptr, "in Python: asammdf.MDF(FILE).export('csv')"},
      {".svdx", "a project of TwinCAT's scope", nullptr, "export it as CSV (TC3 Scope Export Tool)"},
      {".gz", "compressed", nullptr, "gunzip FILE"},
      {".zip", "an archive", nullptr, "unzip FILE"},
      {".yaml", "a configuration", nullptr, "name the recording itself"},
      {".yml", "a configuration", nullptr, "name the recording itself"},
  };
  return all;
}

}  // namespace

const FileKind& kind_of(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const FileKind& kind : kinds())
    if (kind.ending == ending) return kind;
  return kinds().front();
}

std::unique_ptr<ArrayFile> open_arrays(const std::string& path, const RecordingColumns& columns) {
  const FileKind& kind = kind_of(path);
  if (kind.open) return kind.open(path, columns);
  throw ConfigError(
      path,
      fmt::format(
          "is {}, which is not read, expected a CSV, .mat, .npz, HDF5, MCAP, .db3, WPILOG or JSON of it ({})",
          kind.called, kind.convert));
}

}  // namespace gapscope::internal::recording
