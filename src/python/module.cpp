// The module behind the Python package: a call of a command each. What users see is gapscope/__init__.py.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <filesystem>

#include "commands/check.h"
#include "commands/diagnose.h"
#include "commands/drive_folder.h"
#include "commands/estimate.h"
#include "commands/export.h"
#include "gapscope/base/errors.h"
#include "gapscope/base/version.h"
#include "python/asked.h"
#include "python/watched_work.h"
#include "results/drive_card.h"

namespace gapscope::internal::python {
namespace {

namespace py = pybind11;

/// What a call leaves, before Python sees it.
struct Answer {
  StoredResult stored;
  std::vector<TextFile> texts;
  std::vector<std::string> warnings;
  std::optional<BoundMap> map;
};

/// A vector as the memory of an array, which keeps it.
template <class Value, class Element = Value>
py::array array_of(std::vector<Value> values, std::vector<py::ssize_t> shape = {}) {
  auto* const kept = new std::vector<Value>(std::move(values));
  const py::capsule owner(kept, [](void* p) { delete static_cast<std::vector<Value>*>(p); });
  if (shape.empty()) shape = {static_cast<py::ssize_t>(kept->size())};
  return py::array_t<Element>(shape, reinterpret_cast<const Element*>(kept->data()), owner);
}

py::dict traces_of(std::vector<StoredTable>& tables) {
  py::dict traces;
  for (StoredTable& table : tables) {
    py::dict columns;
    for (StoredColumn& c : table.columns)
      columns[c.name.c_str()] =
          c.modes.empty() ? array_of(std::move(c.numbers)) : array_of<Mode, signed char>(std::move(c.modes));
    traces[table.name.c_str()] = columns;
  }
  return traces;
}

py::dict told(Answer& a) {
  py::dict files;
  for (const TextFile& f : a.texts) files[f.name.c_str()] = py::bytes(f.text);
  py::dict all;
  all["json"] = py::bytes(a.stored.json);
  all["traces"] = traces_of(a.stored.traces);
  all["files"] = files;
  all["warnings"] = a.warnings;
  all["bound_map"] = py::none();
  if (a.map)
    all["bound_map"] = array_of(std::move(a.map->levels), {static_cast<py::ssize_t>(a.map->columns()),
                                                           static_cast<py::ssize_t>(a.map->bounds.size())});
  return all;
}

/// Does the work of a command with its configuration.
template <class Work>
py::dict answer(const Asked& asked, const py::object& progress, const Work& work) {
  Answer a;
  watch(progress, [&](const Progress& tell) {
    telling_settings(settings_of(asked), [&] {
      const Configuration c = configuration_of(asked);
      work(c, a, tell);
    });
  });
  return told(a);
}

py::dict check(const Asked& asked, const std::string& purpose, int which, const py::object& progress) {
  return answer(asked, progress, [&](const Configuration& c, Answer& a, const Progress&) {
    const Configuration reading = reading_of_one(c, which);
    const RecordedFile& file = reading.recording->files.front();
    const bool given = !asked.folder.empty() && file.path.starts_with(asked.folder + "/");
    for (const Purpose p : {Purpose::kAll, Purpose::kGap, Purpose::kFit, Purpose::kDiagnosis})
      if (purpose == to_string(p)) {
        const CheckedRecording checked = checked_recording(reading, p, given ? file.given : "");
        a.stored.json = checked.json;
        a.texts = {{"report.txt", checked.inspection.report()}};
        return;
      }
    throw ConfigError("purpose is " + purpose + ", expected all, gap, fit or diagnosis");
  });
}

py::dict estimate(const Asked& asked, bool model_free, bool reference, const std::string& output, bool svg,
                  const py::object& progress) {
  return answer(asked, progress, [&](const Configuration& c, Answer& a, const Progress& tell) {
    std::optional<ReportFolder> report;
    if (!output.empty()) report.emplace(drive_folder(output, c));
    RunOutcome outcome = make_estimate(c, {model_free, reference}, tell);
    if (outcome.result.model_free) a.map = outcome.result.model_free->map;
    if (report) {
      a.stored = stored_run_result(outcome.result);
      tell("drawing the report");
      write_estimate(*report, c, {svg}, outcome);
    } else {
      add_card(outcome.result);
      a.texts = estimate_texts(c, outcome.result);
      a.stored = stored_run_result(std::move(outcome.result));
    }
    a.warnings = outcome.warnings;
  });
}

py::dict diagnose(const Asked& asked, const std::vector<std::string>& excluded,
                  const std::vector<std::string>& simulated, int threads, const std::string& output, bool svg,
                  const py::object& progress) {
  return answer(asked, progress, [&](Configuration c, Answer& a, const Progress& tell) {
    exclude_effects(excluded, c);
    take_simulated(simulated, c);
    require_reference_model(c);
    std::optional<ReportFolder> report;
    if (!output.empty()) report.emplace(drive_folder(output, c));
    DiagnosisOptions options = diagnosis_options(c);
    options.threads = threads;
    options.progress = tell;
    DiagnosisOutcome outcome = run_diagnosis(c, options);
    if (report) {
      tell("drawing the report");
      write_diagnosis(*report, c, {svg}, outcome);
    } else {
      add_card(outcome.result);
      a.texts = diagnosis_texts(c, outcome.result, outcome.first.motor_trace());
    }
    a.stored = stored_diagnosis_result(outcome.result);
    a.warnings = outcome.result.diagnosis.warnings;
    if (outcome.result.simulated)
      a.warnings.insert(a.warnings.end(), outcome.result.simulated->warnings.begin(),
                        outcome.result.simulated->warnings.end());
  });
}

py::dict export_model(const Asked& asked, const std::string& to, const std::string& output,
                      const py::object& progress) {
  return answer(asked, progress, [&](const Configuration& c, Answer& a, const Progress& tell) {
    const ExportFormat format = export_format(to);
    std::optional<ReportFolder> report;
    if (!output.empty()) report.emplace(output, FolderKind::kExport, source_paths(c));
    tell("exporting " + c.name);
    DriveExport drive = export_drive(c, format);
    tell_in_head(left_unexplained(asked.file), drive);
    if (report) write_export(*report, drive);
    a.texts = export_texts(drive);
    a.stored.json = certificate_json(drive.certificate);
    a.warnings = drive.certificate.warnings;
  });
}

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// @param given  (name, {key: array of one dimension}), which outlives the call
std::vector<GivenRecording> recordings_of(const std::vector<std::pair<std::string, py::dict>>& given) {
  std::vector<GivenRecording> all;
  for (const auto& [name, columns] : given) {
    all.push_back({name, {}});
    for (const auto& [key, values] : columns) {
      const auto array = py::cast<Numbers>(values);
      all.back().columns.push_back(
          {py::cast<std::string>(key), {array.data(), static_cast<std::size_t>(array.size())}});
    }
  }
  return all;
}

void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const ConfigError& error) {
    PyErr_SetString(PyExc_ValueError, in_its_folder(error.what()).c_str());
  } catch (const std::filesystem::filesystem_error& error) {
    PyErr_SetString(PyExc_OSError, error.what());
  } catch (const MachineError& error) {
    PyErr_SetString(PyExc_OSError, error.what());
  }
}

PYBIND11_MODULE(_gapscope, m) {
  py::register_exception_translator(translate);
  m.attr("version") = version();
  py::dict formats;
  for (const ExportFormatSpec& f : export_formats()) formats[f.name] = f.doc;
  m.attr("formats") = formats;
  using GivenArrays = std::vector<std::pair<std::string, py::dict>>;
  py::class_<Asked>(m, "Asked")
      .def(py::init([](std::string text, std::string file,
                       const std::vector<std::pair<std::string, std::string>>& settings, std::string folder,
                       std::string axis, const GivenArrays& recordings, const GivenArrays& held_out,
                       const GivenArrays& simulated) {
             Asked asked{std::move(text), std::move(file)};
             for (const auto& [key, yaml] : settings) asked.settings.push_back({key, yaml});
             asked.folder = std::move(folder), asked.axis = std::move(axis);
             asked.recordings = recordings_of(recordings);
             asked.held_out = recordings_of(held_out), asked.simulated = recordings_of(simulated);
             return asked;
           }),
           py::keep_alive<1, 7>(), py::keep_alive<1, 8>(), py::keep_alive<1, 9>());
  m.def("exported_configuration", &exported_configuration);
  m.def("check", &check);
  m.def("estimate", &estimate);
  m.def("diagnose", &diagnose);
  m.def("export", &export_model);
}

}  // namespace
}  // namespace gapscope::internal::python
