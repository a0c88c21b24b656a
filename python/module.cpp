// SPDX-License-Identifier: GPL-3.0-or-later
// What Python's package (python/standpoint) has of C++: the table of verbs, verbs that run without Python's lock,
// clouds and meshes as arrays that view memory of C++.
#include <condition_variable>
#include <exception>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <thread>
#include <utility>

#include "core/data_folder.h"
#include "emulated-ui/verbs/rehearse_verb.h"
#include "pointclouds/formats.h"
#include "project/dataset/program_version.h"
#include "python/kept_cloud.h"
#include "python/open_project.h"

namespace py = pybind11;

namespace standpoint {

namespace {

using nlohmann::json;

// An Error on its way to Python, where standpoint/_errors.py knows the class of each kind.
struct Refused {
  Error error;
};

const char* nameOf(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::usage: return "usage";
    case ErrorKind::unusable: return "unusable";
    case ErrorKind::file_system: return "file_system";
    case ErrorKind::cancelled: return "cancelled";
    case ErrorKind::internal: return "internal";
  }
  return "internal";
}

const char* nameOf(ParameterKind kind) {
  switch (kind) {
    case ParameterKind::text: return "text";
    case ParameterKind::number: return "number";
    case ParameterKind::integer: return "integer";
    case ParameterKind::flag: return "flag";
    case ParameterKind::choice: return "choice";
    case ParameterKind::path: return "path";
    case ParameterKind::triple: return "triple";
    case ParameterKind::pairs: return "pairs";
    case ParameterKind::list: return "list";
  }
  return "text";
}

const char* nameOf(VerbScope scope) {
  switch (scope) {
    case VerbScope::creates: return "creates";
    case VerbScope::changes: return "changes";
    case VerbScope::reads: return "reads";
    case VerbScope::files: return "files";
  }
  return "files";
}

// Names come from files, and not every file keeps to UTF-8.
std::string asText(const json& value) { return value.dump(-1, ' ', false, json::error_handler_t::replace); }

std::string verbTable() {
  json table = json::array();
  for (const auto& verb : allVerbs()) {
    json parameters = json::array();
    for (const auto& p : verb.parameters)
      parameters.push_back({{"name", p.name},
                            {"kind", nameOf(p.kind)},
                            {"help", fullHelp(p)},
                            {"domain", domainOf(p)},
                            {"default", p.default_value},
                            {"choices", p.choices},
                            {"positional", p.positional},
                            {"required", p.required}});
    table.push_back({{"name", verb.name},
                     {"summary", verb.summary},
                     {"scope", nameOf(verb.scope)},
                     {"parameters", std::move(parameters)},
                     {"answer", verb.answer_names}});
  }
  return asText(table);
}

// One run of a function that takes Progress&, in a thread of its own and without Python's lock. This thread, which
// called, looks after Python ten times a second: signals, and `watch(fraction, stage)` where it is not None. What they
// raise cancels the work, and is raised once that has ended.
template <class T>
class WatchedRun {
 public:
  explicit WatchedRun(std::function<Result<T>(Progress&)> work)
      : worker_([this, work = std::move(work)] {
          try {
            result_ = work(progress_);
          } catch (...) {
            broken_ = std::current_exception();
          }
          const std::lock_guard lock(mutex_);
          ended_ = true;
          wake_.notify_one();
        }) {}

  T take(const py::object& watch) {
    std::exception_ptr raised;
    while (!endsSoon()) {
      if (raised) continue;
      try {
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
        tell(watch);
      } catch (...) {
        raised = std::current_exception();
        progress_.cancel();
      }
    }
    worker_.join();
    if (raised) std::rethrow_exception(raised);
    if (broken_) std::rethrow_exception(broken_);
    if (!*result_) throw Refused{std::move(*result_).error()};
    if (!watch.is_none()) watch(1.0, progress_.stageName());
    return **std::move(result_);
  }

 private:
  bool endsSoon() {
    const py::gil_scoped_release others;
    std::unique_lock lock(mutex_);
    return wake_.wait_for(lock, std::chrono::milliseconds(100), [this] { return ended_; });
  }

  void tell(const py::object& watch) {
    if (watch.is_none()) return;
    const double fraction = progress_.fraction();
    auto stage = progress_.stageName();
    if (fraction == told_ && stage == told_stage_) return;
    told_ = fraction;
    told_stage_ = stage;
    watch(fraction, std::move(stage));
  }

  Progress progress_;
  double told_ = -1;
  std::string told_stage_;
  std::optional<Result<T>> result_;
  std::exception_ptr broken_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool ended_ = false;
  std::thread worker_;  // last: it uses the others
};

template <class T>
T watched(const py::object& watch, std::function<Result<T>(Progress&)> work) {
  return WatchedRun<T>(std::move(work)).take(watch);
}

py::list issuesOf(const Report& report) {
  py::list issues;
  for (const auto& issue : report.issues)
    issues.append(py::make_tuple(name(issue.severity), py::bytes(issue.source), py::bytes(issue.message)));
  return issues;
}

py::tuple runVerbFor(const std::string& name, const std::string& options, const py::object& watch,
                     const std::shared_ptr<OpenProject>& project) {
  const Verb* verb = findVerb(allVerbs(), name);
  if (verb == nullptr) throw Refused{{ErrorKind::usage, "there is no such verb", name}};
  const auto outcome = watched<Outcome>(watch, [&](Progress& progress) {
    auto said = json::parse(options);
    return project ? project->run(*verb, std::move(said), progress) : runOnDisk(*verb, said, progress);
  });
  return py::make_tuple(py::bytes(asText(outcome.answer)), py::bytes(outcome.description), py::bytes(outcome.text),
                        issuesOf(outcome.report));
}

// An array that views `values`, which `owner` keeps: read-only, since others see the same memory.
template <class T, class Owner>
py::array view(const std::shared_ptr<Owner>& owner, const std::vector<T>& values, py::ssize_t width = 1) {
  const py::capsule base(new std::shared_ptr<Owner>(owner),
                         [](void* held) { delete static_cast<std::shared_ptr<Owner>*>(held); });
  const auto size = static_cast<py::ssize_t>(values.size());
  const auto bytes = static_cast<py::ssize_t>(sizeof(T));
  py::array array = width == 1 ? py::array_t<T>({size}, {bytes}, values.data(), base)
                               : py::array_t<T>({size / width, width}, {width * bytes, bytes}, values.data(), base);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

template <class T>
py::array whole(std::vector<T> values, py::ssize_t width) {
  const auto owner = std::make_shared<const std::vector<T>>(std::move(values));
  return view(owner, *owner, width);
}

py::dict columnsOf(const std::shared_ptr<const KeptScan>& scan) {
  py::dict columns;
  eachColumn(scan->points, [&](const char* name, const auto& column) {
    if (!column.empty()) columns[name] = view(scan, column);
  });
  return columns;
}

py::array matrixOf(const Pose& pose) {
  std::vector<double> matrix(16, 0.0);
  const Eigen::Matrix3d turned = pose.rotation.toRotationMatrix();
  for (Eigen::Index row = 0; row < 3; ++row) {
    for (Eigen::Index column = 0; column < 3; ++column)
      matrix[static_cast<std::size_t>(4 * row + column)] = turned(row, column);
    matrix[static_cast<std::size_t>(4 * row + 3)] = pose.translation[row];
  }
  matrix[15] = 1;
  return whole(std::move(matrix), 4);
}

py::list rowsOf(const std::vector<LabelledProduct>& products) {
  py::list rows;
  for (const auto& p : products)
    rows.append(py::make_tuple(py::bytes(p.id), py::bytes(p.global_id), py::bytes(p.ifc_class), py::bytes(p.name)));
  return rows;
}

py::list rowsOf(const std::vector<Product>& products) {
  py::list rows;
  for (const auto& p : products)
    rows.append(py::make_tuple(py::bytes(p.id), py::bytes(p.global_id), py::bytes(p.ifc_class), py::bytes(p.name),
                               py::bytes(p.storey), p.inScene()));
  return rows;
}

py::list textsOf(const std::vector<std::string>& texts) {
  py::list all;
  for (const auto& text : texts) all.append(py::bytes(text));
  return all;
}

void defineScan(py::module_& m) {
  py::class_<KeptScan, std::shared_ptr<KeptScan>> scan(m, "Scan");
  scan.def("__len__", [](const KeptScan& s) { return s.points.size(); });
  scan.def("columns", [](const std::shared_ptr<KeptScan>& s) { return columnsOf(s); });
  scan.def("places", [](const KeptScan& s) { return whole(placesInFile(s), 3); });
  scan.def("true_places", [](const KeptScan& s) -> py::object {
    return s.header.has_truth ? py::object(whole(truePlacesInFile(s), 3)) : py::none();
  });
  scan.def("products", [](const KeptScan& s) { return rowsOf(s.header.products); });
  scan.def("header", [](const KeptScan& s) {
    const auto& h = s.header;
    py::dict header;
    header["name"] = py::bytes(h.name);
    header["guid"] = py::bytes(h.guid);
    header["description"] = py::bytes(h.description);
    header["sensor_vendor"] = py::bytes(h.sensor_vendor);
    header["sensor_model"] = py::bytes(h.sensor_model);
    header["sensor_serial"] = py::bytes(h.sensor_serial);
    header["coordinate_metadata"] = py::bytes(h.coordinate_metadata);
    header["rows"] = h.rows;
    header["columns"] = h.columns;
    header["intensity_min"] = h.intensity_min;
    header["intensity_max"] = h.intensity_max;
    header["acquisition_start_gps_s"] = h.acquisition_start_gps_s;
    header["acquisition_seconds"] = h.acquisition_seconds;
    header["materials"] = textsOf(h.materials);
    header["file_from_scanner"] = matrixOf(h.file_from_scanner);
    header["true_file_from_scanner"] = matrixOf(truePose(h));
    return header;
  });
}

struct ReadCloud {
  std::vector<std::shared_ptr<KeptScan>> scans;
  Report report;
};

py::tuple readCloudFor(const std::filesystem::path& file, const py::object& watch) {
  auto cloud = watched<ReadCloud>(watch, [&](Progress& progress) -> Result<ReadCloud> {
    progress.stage("Read " + file.filename().string());
    KeepingSink sink;
    TRY_ASSIGN(auto report, readCloud(file, sink, progress));
    return ReadCloud{std::move(sink.scans), std::move(report)};
  });
  py::list scans;
  for (const auto& scan : cloud.scans) scans.append(scan);
  return py::make_tuple(scans, issuesOf(cloud.report));
}

void defineProject(py::module_& m) {
  py::class_<OpenProject, std::shared_ptr<OpenProject>> project(m, "OpenProject");
  project.def(py::init<std::filesystem::path>());
  project.def("products", [](OpenProject& p, const py::object& watch) {
    const auto document = watched<Document>(watch, [&](Progress& progress) { return p.document(progress); });
    return rowsOf(document.imported->products);
  });
  project.def("mesh", [](OpenProject& p, const py::object& watch) {
    auto placed = watched<PlacedMesh>(watch, [&](Progress& progress) -> Result<PlacedMesh> {
      TRY_ASSIGN(const auto document, p.document(progress));
      return placedMesh(document);
    });
    const auto mesh = std::make_shared<const PlacedMesh>(std::move(placed));
    py::dict arrays;
    arrays["vertices"] = view(mesh, mesh->vertices, 3);
    arrays["faces"] = view(mesh, mesh->faces, 3);
    arrays["product"] = view(mesh, mesh->product);
    arrays["material"] = view(mesh, mesh->material);
    arrays["materials"] = textsOf(mesh->materials);
    arrays["products"] = rowsOf(mesh->environment->products);
    return arrays;
  });
}

py::dict pointFlags() {
  py::dict flags;
  flags["MIXED"] = point_flag::kMixed;
  flags["MIRRORED"] = point_flag::kMirrored;
  flags["THROUGH_PANE"] = point_flag::kThroughPane;
  flags["WEATHER"] = point_flag::kWeather;
  flags["SATURATED"] = point_flag::kSaturated;
  flags["MOVING"] = point_flag::kMoving;
  flags["NOISE"] = point_flag::kNoise;
  flags["FILTERED"] = point_flag::kFiltered;
  return flags;
}

void raiseAsPython(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(std::move(thrown));
  } catch (const Refused& refused) {
    const auto& [kind, message, source] = refused.error;
    const py::object raised =
        py::module_::import("standpoint._errors").attr("error_of")(nameOf(kind), py::bytes(message), py::bytes(source));
    PyErr_SetObject(reinterpret_cast<PyObject*>(Py_TYPE(raised.ptr())), raised.ptr());
  }
}

}  // namespace

PYBIND11_MODULE(_native, m) {
  m.doc() = "What the package standpoint has of C++; use the package.";
  py::register_exception_translator(raiseAsPython);
  m.def("version", programVersion);
  m.def("use_data", useDataFolder);
  m.def("samples_folder", samplesFolder);
  m.def("verb_table", verbTable);
  m.def("point_flags", pointFlags);
  m.def("run", runVerbFor);
  m.def("read_cloud", readCloudFor);
  defineScan(m);
  defineProject(m);
}

}  // namespace standpoint
