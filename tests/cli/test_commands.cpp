#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "cli/executable.h"
#include "gapscope/base/statistics.h"
#include "support/paper_model.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;
using testing::kPaperModel;
using ::testing::Not;
using testing::stored;
using testing::text_of;
using testing::Workplace;

// The paper's rig for two seconds at a coarse rate: quick, and the gap is crossed four times.
const std::string kConfig = R"(name: quick
encoder: {bits: 18}
simulation:
  rate: 1000
  duration: 2
  seed: 3
  excitation: {sine: {amplitude: 0.58, frequency: 1}}
model: )" + kPaperModel;

TEST(Commands, HelpAndVersionAreAnswersOnStandardOutput) {
  const Workplace place;
  EXPECT_THAT(place.run("--version").out, ::testing::StartsWith("gapscope "));
  for (const char* command :
       {"check", "compare", "init", "run", "detect", "fit", "diagnose", "simulate", "report"}) {
    const auto help = place.run(std::string(command) + " --help");
    EXPECT_EQ(help.status, 0);
    EXPECT_THAT(help.out, HasSubstr(std::string("Example: gapscope ") + command));
    EXPECT_EQ(help.err, "");
  }
  const auto simulate = place.run("simulate --help");
  for (const char* key :
       {"sine", "multisine", "swept_sine", "triangle", "trapezoid", "steps", "stop_frequency [Hz]"})
    EXPECT_THAT(simulate.out, HasSubstr(key));
}

TEST(Commands, RunReplacesAnOldReportAndSaysWhatItFound) {
  Workplace place;
  place.file("c.yaml", kConfig);
  ASSERT_EQ(place.run("detect c.yaml").status, 0);
  place.file("reports/quick/mine.txt", "kept");
  const auto run = place.run("run c.yaml");
  ASSERT_EQ(run.status, 0) << run.err;
  for (const char* word : {"reports/quick", "model-free", "fitted", "load side", "mrad"})
    EXPECT_THAT(run.out, HasSubstr(word));
  EXPECT_THAT(run.err, Not(HasSubstr("...")));  // no terminal, no progress
  EXPECT_THAT(run.out, Not(HasSubstr("warning")));
  const auto content = place.content();
  for (const char* file : {"report.md", "resolved.yaml", "timing.json", "traces/1_quick.csv", "mine.txt"})
    EXPECT_TRUE(content.count(std::string("reports/quick/") + file)) << file;
  const std::string result = text_of(place.folder() / "reports/quick/result.json");
  EXPECT_THAT(result, HasSubstr("gapscope.result/1"));
  EXPECT_THAT(result, Not(HasSubstr("\"reference\": null")));
}

TEST(Commands, TheSameInputGivesTheSameBytes) {
  Workplace place;
  place.file("c.yaml", kConfig);
  ASSERT_EQ(place.run("run c.yaml -o a").status, 0);
  ASSERT_EQ(place.run("run a/resolved.yaml -o b").status, 0);  // every default filled in: the same input
  const std::string a = stored(place.folder() / "a");
  EXPECT_TRUE(a == stored(place.folder() / "b"));
  for (const auto& entry : std::filesystem::directory_iterator(place.folder() / "b"))
    if (entry.path().extension() == ".png" || entry.path().extension() == ".md")
      std::filesystem::remove(entry.path());
  ASSERT_FALSE(a == stored(place.folder() / "b"));
  ASSERT_EQ(place.run("report b").status, 0);  // drawn again from what is stored
  EXPECT_TRUE(a == stored(place.folder() / "b"));
}

TEST(Commands, DiagnoseNamesWhatTheModelLacksBesideTheEstimates) {
  Workplace place;
  std::string config = kConfig;
  config.replace(config.find("  excitation"), 0,
                 "  model: {effects: [{motor_coulomb_friction: {level_nm: 0.02}}]}\n");
  place.file("c.yaml", config);
  ASSERT_EQ(place.run("run c.yaml").status, 0);
  const std::string few =
      testing::excluding_all_but({"motor_coulomb_friction", "cogging_torque", "quadratic_drag"});
  const auto diagnosed = place.run("diagnose c.yaml" + few);
  ASSERT_EQ(diagnosed.status, 0) << diagnosed.err;
  EXPECT_THAT(diagnosed.out, HasSubstr("motor_coulomb_friction"));
  EXPECT_THAT(diagnosed.err, HasSubstr("last third"));
  EXPECT_THAT(diagnosed.err, HasSubstr("effects of the catalogue were no candidate, as was asked for"));
  const auto content = place.content();
  for (const char* file : {"diagnosis.json", "fitted.yaml", "diagnosis.png", "result.json", "overview.png",
                           "traces/held_out_1_quick.csv", "traces/1_quick.csv"})
    EXPECT_TRUE(content.count(std::string("reports/quick/") + file)) << file;
  const std::string report = text_of(place.folder() / "reports/quick/report.md");
  EXPECT_THAT(report, HasSubstr("what the simulation lacks"));
  EXPECT_THAT(report, HasSubstr("## Estimates"));
  const auto simulated = place.run("simulate reports/quick/fitted.yaml -o f.csv");
  EXPECT_EQ(simulated.status, 0) << simulated.err;
  const auto wrong = place.run("diagnose c.yaml --exclude gremlins");
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.err, HasSubstr("gremlins"));
}

/// Largest difference of a column of numbers in two CSV files.
double largest_difference(const std::string& a, const char* column_a, const std::string& b,
                          const char* column_b) {
  const auto numbers = [](const std::string& text, const std::string& column) {
    std::istringstream lines(text);
    std::string line, field;
    std::getline(lines, line);
    std::istringstream header(line);
    int place = 0;
    while (std::getline(header, field, ',') && field != column) ++place;
    std::vector<double> values;
    while (std::getline(lines, line)) {
      std::istringstream row(line);
      for (int i = 0; i <= place; ++i) std::getline(row, field, ',');
      values.push_back(std::stod(field));
    }
    return values;
  };
  const std::vector<double> x = numbers(a, column_a), y = numbers(b, column_b);
  if (x.size() != y.size()) return kInfinity;
  double largest = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) largest = std::max(largest, std::abs(x[i] - y[i]));
  return largest;
}

TEST(Commands, TheFittedModelBesideAFitIsSimulatedAsItIs) {
  Workplace place;
  place.file("c.yaml", kConfig);
  ASSERT_EQ(place.run("simulate c.yaml -o drive.csv").status, 0);
  const std::string model = kConfig.substr(kConfig.find("model:"));
  place.file("r.yaml", "name: recorded\nrecording: {file: drive.csv}\nencoder: {bits: 18}\n" + model);
  for (const char* config : {"c", "r"}) {
    const std::string folder = config;
    ASSERT_EQ(place.run("fit " + folder + ".yaml -o " + folder).status, 0);
    const auto run = place.run("simulate " + folder + "/fitted.yaml -o " + folder + ".csv");
    ASSERT_EQ(run.status, 0) << run.err;
    const std::string trace =
        text_of(place.folder() / folder / "traces" / (folder == "c" ? "1_quick.csv" : "1_drive.csv"));
    // The free run of the fit, but for the quantum of 18 bit.
    EXPECT_LE(largest_difference(trace, "fit_x1_rad", text_of(place.folder() / (folder + ".csv")), "x1"),
              1.3e-5);
  }
}

TEST(Commands, ALinearAxisIsWarnedOfInItsUnits) {
  Workplace place;
  place.file("c.yaml", R"(name: axis
encoder: {quantum: 1.0e-7}
coordinates: translation
simulation: {rate: 500, duration: 3, excitation: {sine: {amplitude: 20, frequency: 1}}}
model:
  parameters: {motor_inertia: 10, torque_constant: 1, mass_ratio: 0, motor_damping: 30}
)");
  ASSERT_EQ(place.run("simulate c.yaml -o axis.csv").status, 0);
  place.file("r.yaml", R"(name: axis
recording: {file: axis.csv}
encoder: {quantum: 1.0e-7}
coordinates: translation
model:
  parameters: {motor_inertia: 10, torque_constant: 1, mass_ratio: 0,
               motor_damping: {value: 10, estimate: true, bounds: [0, 20]}}
)");
  const auto fit = place.run("fit r.yaml -o report");
  ASSERT_EQ(fit.status, 0) << fit.err;
  EXPECT_THAT(fit.err, HasSubstr("motor_damping ended at the limit of its search, 20 N s/m"));
  EXPECT_THAT(text_of(place.folder() / "report/report.md"), Not(HasSubstr("N m")));
}

TEST(Commands, DiagnoseChecksWhatIsFittedAndWhatIsHeldOutAlike) {
  Workplace place;
  const std::string model =
      "encoder: {bits: 16}\nmodel:\n  parameters: {motor_inertia: 0.001, torque_constant: 1, mass_ratio: 0, "
      "motor_damping: {value: 0.01, estimate: true}}\n";
  place.file("c.yaml",
             "name: body\nsimulation: {rate: 200, duration: 3, excitation: {sine: {amplitude: 0.05, "
             "frequency: 1}}}\n" +
                 model);
  ASSERT_EQ(place.run("simulate c.yaml -o good.csv").status, 0);
  std::istringstream good(text_of(place.folder() / "good.csv"));
  std::string turned, row;
  std::getline(good, turned);
  turned += "\n";
  while (std::getline(good, row)) {  // u is the second column
    const std::size_t u = row.find(',') + 1;
    turned += row.substr(0, u) + (row[u] == '-' ? row.substr(u + 1) : "-" + row.substr(u)) + "\n";
  }
  place.file("bad.csv", turned);
  const std::string few = testing::excluding_all_but({"quadratic_drag"});
  for (const char* files : {"{file: good.csv, held_out: bad.csv}", "{file: bad.csv, held_out: good.csv}"}) {
    place.file("d.yaml", std::string("name: d\nrecording: ") + files + "\n" + model);
    const auto diagnosed = place.run("diagnose d.yaml -o d" + few);
    EXPECT_EQ(diagnosed.status, 0) << diagnosed.err;
    EXPECT_THAT(diagnosed.err, HasSubstr("warning: bad.csv: sign: ")) << files;
    EXPECT_THAT(diagnosed.err, Not(HasSubstr("good.csv:")));
  }
}

TEST(Commands, TheModelOfADiagnosisRunsUnderTheInputThatWasHeldOut) {
  Workplace place;
  const std::string model =
      "encoder: {bits: 16}\nmodel:\n  parameters: {motor_inertia: 0.001, torque_constant: 1, mass_ratio: 0, "
      "motor_damping: {value: 0.01, estimate: true}}\n";
  for (const char* frequency : {"1", "2"}) {
    place.file("c.yaml",
               std::string("name: body\nsimulation: {rate: 200, duration: 3, excitation: {triangle: "
                           "{amplitude: 0.05, frequency: ") +
                   frequency + "}}}\n" + model);
    ASSERT_EQ(place.run(std::string("simulate c.yaml -o at_") + frequency + ".csv").status, 0);
  }
  place.file("d.yaml", "name: d\nrecording: {file: at_1.csv, held_out: at_2.csv}\n" + model);
  const auto diagnosed = place.run("diagnose d.yaml -o d" + testing::excluding_all_but({"quadratic_drag"}));
  ASSERT_EQ(diagnosed.status, 0) << diagnosed.err;
  const auto simulated = place.run("simulate d/fitted.yaml -o model.csv");
  ASSERT_EQ(simulated.status, 0) << simulated.err;
  const std::string held_out = text_of(place.folder() / "at_2.csv"),
                    run = text_of(place.folder() / "model.csv");
  EXPECT_LE(largest_difference(held_out, "u", run, "u"), 1e-12);
  EXPECT_LE(largest_difference(held_out, "x1", run, "x1"),
            0.003);  // of 0.5 rad
}

TEST(Commands, DetectAndFitLeaveTheOtherEstimateNull) {
  Workplace place;
  place.file("c.yaml", kConfig);
  ASSERT_EQ(place.run("detect c.yaml -o d").status, 0);
  const auto fit = place.run("fit c.yaml -o f");
  ASSERT_EQ(fit.status, 0) << fit.err;
  EXPECT_THAT(fit.out, HasSubstr("\n  motor_damping           0.06"));
  const std::string detected = text_of(place.folder() / "d/result.json");
  const std::string fitted = text_of(place.folder() / "f/result.json");
  EXPECT_THAT(detected, HasSubstr("\"reference\": null"));
  EXPECT_THAT(detected, Not(HasSubstr("\"model_free\": null")));
  EXPECT_THAT(fitted, HasSubstr("\"model_free\": null"));
  EXPECT_THAT(fitted, Not(HasSubstr("\"reference\": null")));
}

TEST(Commands, ASimulatedRecordingReadBackIsDetectedLikeTheSimulationItself) {
  Workplace place;
  place.file("c.yaml", kConfig);
  const auto simulated = place.run("simulate c.yaml -o quick");
  ASSERT_EQ(simulated.status, 0) << simulated.err;
  EXPECT_THAT(text_of(place.folder() / "quick"), ::testing::StartsWith("t,u,x1,x2,mode\n0,"));
  place.file("r.yaml", "name: quick\nencoder: {bits: 18}\nrecording: {file: quick}\n");
  ASSERT_EQ(place.run("detect c.yaml -o a").status, 0);
  ASSERT_EQ(place.run("detect r.yaml -o b").status, 0);
  // All that tells them apart is the true gap, which a recording does not know, and the published bound,
  // which needs a model and is only told.
  const auto model_free = [&](const char* folder) {
    std::string text = text_of(place.folder() / folder / "result.json");
    const auto bound = text.find("\"paper_bound_rad_s2\"");
    text.erase(bound, text.find('\n', bound) - bound);
    const auto begin = text.find("\"model_free\"");
    return text.substr(begin, text.find("\n \"", begin) - begin);
  };
  EXPECT_EQ(model_free("a"), model_free("b"));
  EXPECT_THAT(model_free("a"), HasSubstr("events"));
}

TEST(Commands, AnInterruptGivesStatus130AndLeavesNothing) {
  Workplace place;
  std::string longer = kConfig;
  longer.replace(longer.find("duration: 2"), 11, "duration: 400");
  place.file("c.yaml", longer);
  // Like a key: without --foreground the whole group is signalled as well, and a second signal ends it at
  // once.
  const auto run = place.run("detect c.yaml", "timeout --foreground --preserve-status -s INT 1");
  EXPECT_EQ(run.status, 130);
  EXPECT_THAT(run.err, HasSubstr("interrupted"));
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(place.content(), (std::set<std::string>{"c.yaml"}));
}

TEST(Commands, WorkThatFailsGivesStatusOne) {
  Workplace place;
  place.file("c.yaml", kConfig);
  EXPECT_EQ(place.run("simulate c.yaml -o /dev/full").status, 1);
  EXPECT_EQ(place.run("simulate c.yaml -o o.csv", "ulimit -f 1; trap '' XFSZ;").status, 1);
  EXPECT_EQ(place.content(), (std::set<std::string>{"c.yaml"}));
}

}  // namespace
}  // namespace gapscope
