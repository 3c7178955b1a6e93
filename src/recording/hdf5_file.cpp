// HDF5, by its library in processes of their own: a damaged file can end it, and it is not made for threads.
#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <stdexcept>

#include "base/run_apart.h"
#include "base/shown.h"
#include "gapscope/base/errors.h"
#include "recording/array_file.h"

namespace gapscope::internal::recording {
namespace {

constexpr hsize_t kLargestChunk = hsize_t{1} << 28;  ///< that is unpacked at once [bytes]

/// What the library gives a number for and wants back.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  hid_t get() const { return id_; }
  explicit operator bool() const { return id_ >= 0; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// What is said of a dataset before it is read; its size follows as bytes.
struct DatasetText {
  std::string flaw, remedy;
  std::vector<hsize_t> size;
};

void tell_type(hid_t dataset, DatasetText& text) {
  const Handle type(H5Dget_type(dataset), H5Tclose);
  switch (H5Tget_class(type.get())) {
    case H5T_INTEGER:
    case H5T_FLOAT:
      return;
    case H5T_STRING:
      text.flaw = "is a text", text.remedy = "write numbers";
      return;
    case H5T_COMPOUND:
      text.flaw = "has fields of its own", text.remedy = "write a dataset for each field";
      return;
    default:
      text.flaw = "is no array of numbers", text.remedy = "write floating-point numbers";
  }
}

void tell_chunks(hid_t dataset, DatasetText& text) {
  const Handle plan(H5Dget_create_plist(dataset), H5Pclose);
  const Handle type(H5Dget_type(dataset), H5Tclose);
  if (H5Pget_layout(plan.get()) != H5D_CHUNKED) return;
  std::vector<hsize_t> chunk(H5S_MAX_RANK);
  const int rank = H5Pget_chunk(plan.get(), H5S_MAX_RANK, chunk.data());
  hsize_t bytes = H5Tget_size(type.get());
  for (int i = 0; i < rank; ++i)
    bytes = std::min(bytes, kLargestChunk + 1) * std::min(chunk[i], kLargestChunk);
  if (bytes > kLargestChunk)
    text.flaw = "is stored in pieces of more than 256 MiB", text.remedy = "h5repack -l CHUNK=65536 IN OUT";
  for (int i = 0; i < H5Pget_nfilters(plan.get()); ++i) {
    unsigned flags = 0;
    char name[64] = {};
    std::size_t none = 0;
    const H5Z_filter_t filter = H5Pget_filter2(plan.get(), static_cast<unsigned>(i), &flags, &none, nullptr,
                                               sizeof name, name, nullptr);
    if (H5Zfilter_avail(filter) > 0) continue;
    text.flaw =
        fmt::format("is compressed by {}, which HDF5 itself has not", name[0] != 0 ? name : "a plug-in");
    text.remedy = "where it can be read: h5repack -f GZIP=1 IN OUT";
  }
}

Handle dataset_of(const Handle& file, const std::string& name) {
  return {H5Dopen2(file.get(), name.c_str(), H5P_DEFAULT), H5Dclose};
}

std::string told(const Handle& file, const std::string& name) {
  const Handle dataset = dataset_of(file, name);
  if (!dataset) return {};
  DatasetText text;
  const Handle space(H5Dget_space(dataset.get()), H5Sclose);
  const int rank = H5Sget_simple_extent_ndims(space.get());
  text.size.resize(static_cast<std::size_t>(std::max(rank, 0)));
  if (rank > 0) H5Sget_simple_extent_dims(space.get(), text.size.data(), nullptr);
  tell_type(dataset.get(), text);
  if (text.flaw.empty()) tell_chunks(dataset.get(), text);
  return text.flaw + '\0' + text.remedy + '\0' +
         std::string(reinterpret_cast<const char*>(text.size.data()), text.size.size() * sizeof(hsize_t));
}

herr_t add_name(hid_t, const char* name, const H5O_info_t* info, void* all) {
  constexpr std::size_t kMost = 1 << 20;
  auto& text = *static_cast<std::string*>(all);
  if (info->type == H5O_TYPE_DATASET) text += std::string(name) + '\0';
  return text.size() < kMost ? 0 : 1;
}

class Hdf5File : public ArrayFile {
 public:
  explicit Hdf5File(std::string path) : path_(std::move(path)) {
    asked([](const Handle&) { return std::string(); });
  }

  const char* noun() const override { return "dataset"; }

  std::optional<StoredArray> find(const std::string& name) override {
    const std::string answer = asked([&](const Handle& file) { return told(file, name); });
    if (answer.empty()) return {};
    const std::size_t flaw = answer.find('\0'), remedy = answer.find('\0', flaw + 1);
    StoredArray a{name, answer.substr(0, flaw), {}, true, answer.substr(flaw + 1, remedy - flaw - 1)};
    std::vector<hsize_t> size((answer.size() - remedy - 1) / sizeof(hsize_t));
    if (!size.empty()) std::memcpy(size.data(), answer.data() + remedy + 1, size.size() * sizeof(hsize_t));
    a.size.assign(size.begin(), size.end());
    return a;
  }

  std::vector<std::string> names() override {
    const std::string answer = asked([](const Handle& file) {
      std::string all;
      H5Ovisit2(file.get(), H5_INDEX_NAME, H5_ITER_INC, add_name, &all, H5O_INFO_BASIC);
      return all;
    });
    std::vector<std::string> names;
    for (std::size_t at = 0, end; (end = answer.find('\0', at)) != answer.npos; at = end + 1)
      names.push_back(answer.substr(at, end - at));
    return names;
  }

  std::vector<double> numbers(const std::string& name, std::size_t count) override {
    const std::string answer = asked([&](const Handle& file) -> std::string {
      const Handle dataset = dataset_of(file, name);
      const Handle space(H5Dget_space(dataset.get()), H5Sclose);
      if (H5Sget_simple_extent_npoints(space.get()) != static_cast<hssize_t>(count)) return {};
      std::string bytes(count * sizeof(double), '\0');
      const bool read =
          H5Dread(dataset.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()) >= 0;
      return read ? bytes : "";
    });
    std::vector<double> values(answer.size() / sizeof(double));
    if (!values.empty()) std::memcpy(values.data(), answer.data(), values.size() * sizeof(double));
    if (values.size() == count) return values;
    throw ConfigError(path_, fmt::format("the dataset {} is damaged, expected {} numbers as it says itself; "
                                         "h5dump or h5repack may say more",
                                         shown(name), count));
  }

 private:
  std::string asked(const std::function<std::string(const Handle&)>& question) const {
    const auto answer = run_apart([&] {
      H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
      const Handle file(H5Fopen(path_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
      if (!file) throw std::runtime_error("no HDF5");
      return question(file);
    });
    if (answer) return *answer;
    throw ConfigError(
        path_,
        "is damaged or no HDF5, expected a whole file of that format (h5clear -s FILE where the "
        "program that wrote it was ended)");
  }

  std::string path_;
};

}  // namespace

std::unique_ptr<ArrayFile> open_hdf5(const std::string& path) { return std::make_unique<Hdf5File>(path); }

}  // namespace gapscope::internal::recording
