// The error budget of recordings of real drives.
//   study_torque_view [--translation] [--new-phase] [--held] [--locked] [--band=HZ] [--ranks=N] [--vary]
//   FIT.csv ... -- JUDGE.csv ...
// Columns t, u, x1, or the raw ones of a Dynamixel servo (stamped_file.h). One file without "--" is split in
// halves. Prints the octaves, the ladder with the best laws of every rung, the shares and the floors; with
// "--vary" what half and double of each number make of the ladder.
#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <utility>

#include "stamped_file.h"
#include "torque_view/ladder.h"

namespace {

using namespace gapscope::internal::torque_view;

struct Order {
  SplitRecordings data;
  TorqueViewOptions options;
  std::size_t ranks = 4;
  bool held = false, vary = false;
};

Order read_order(int argc, char** argv) {
  Order order;
  bool judge = false;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--")
      judge = true;
    else if (word == "--translation")
      order.data.turns = gapscope::ShaftTurns::of_a_slide();
    else if (word == "--new-phase")
      order.data.new_phase = true;
    else if (word == "--held")
      order.held = true;
    else if (word == "--vary")
      order.vary = true;
    else if (word == "--locked")
      order.data.held_output = true;
    else if (word.starts_with("--band="))
      order.options.given_hz = std::atof(word.c_str() + 7);
    else if (word.starts_with("--ranks="))
      order.ranks = std::strtoul(word.c_str() + 8, nullptr, 10);
    else
      (judge ? order.data.judge : order.data.fit).push_back(test::read_stamped(word));
  }
  if (order.data.judge.empty()) {
    const StampedTrace whole = order.data.fit.front();
    order.data.fit.front() = test::between(whole, 0.0, 0.5);
    order.data.judge.push_back(test::between(whole, 0.5, 1.0));
  }
  for (auto* traces : {&order.data.fit, &order.data.judge})
    for (StampedTrace& t : *traces) t.held_command = order.held;
  return order;
}

std::string text(const Evidence& e) {
  return fmt::format("{:6.3f} [{:.2f}, {:.2f}] {:3.0f} %", e.share, e.interval.low, e.interval.high,
                     100.0 * e.better);
}

std::string text(const Eigen::VectorXd& theta) {
  std::string s;
  for (Eigen::Index i = 0; i < std::min<Eigen::Index>(theta.size(), 4); ++i)
    s += fmt::format(" {:.4g}", theta[i]);
  return s;
}

void print_band(const FrequencyBand& band) {
  fmt::print("octave up to  J          std        N/A     share of J a\n");
  for (const Octave& o : band.octaves)
    fmt::print("{:8.3g} Hz   {:<10.4g} {:<10.4g} {:.3f}   {:.3f}\n", o.top_hz, o.inertia, o.inertia_std,
               o.noise, o.inertial);
  fmt::print("band {:.3g} Hz{}\n", band.hz, band.free_constant ? ", one speed: a free constant" : "");
}

void print_rungs(const Budget& b, std::size_t ranks) {
  const double percent = 100.0 / b.input_rms;
  fmt::print("{:28} {:.4g} ({:.1f} % of {:.4g}) J {:.5g} d {:.4g}\n", "inertia + viscous", b.nominal_rms,
             percent * b.nominal_rms, b.input_rms, b.nominal[0].theta[0], b.nominal[1].theta[0]);
  for (const Rung& r : b.rungs) {
    if (r.ranking.empty()) continue;
    const Candidate& c = r.choice();
    fmt::print("{} {:22} {:.4g} ({:.2f} %) {} | {} {:.2f} behind, {:.2f} | J {:.4g}\n",
               r.named   ? "named "
               : r.helps ? "helps "
                         : "(not) ",
               c.law->name, r.rms, percent * r.rms, text(c.evidence), r.rival, r.margin, r.leading,
               first_coefficient(c.model, "inertia"));
    for (std::size_t i = 0; i < std::min(ranks, r.ranking.size()); ++i)
      fmt::print("         {:26} {:10.4g} {} :{}\n", r.ranking[i].law->name,
                 r.ranking[i].model.back().shape.at, text(r.ranking[i].evidence),
                 text(r.ranking[i].model.back().theta));
    for (const std::string& name : r.group) fmt::print("         same group: {}\n", name);
  }
}

void print_shares(const Budget& b) {
  fmt::print(
      "law                        shape       alone                      last                 s_pred absorbed least\n");
  for (const Share& s : b.shares)
    fmt::print("{:26} {:<10.4g} {} {} {:.2f} {:.2f} {:.3f} x:{}\n", s.law->name, s.shape.at, text(s.alone),
               text(s.last), s.seen.predicted, s.seen.absorbed, s.seen.smallest, text(s.theta));
  for (const std::string& name : b.dropped) fmt::print("dropped: {}\n", name);
  fmt::print(
      "left {:.4g} ({:.2f} %); encoder {:.3g}, repeatability {:.3g}, joint {:.4g}, each {:.4g}, disagreement {:.3g}\n",
      b.rms, 100.0 * b.rms / b.input_rms, b.floors.encoder, b.floors.repeatability, b.floors.joint,
      b.floors.each, b.floors.disagreement());
}

/// The laws that were added, those named with an asterisk, and what is left of the input.
void print_ladder(const std::string& name, const Order& order, const TorqueViewOptions& options) {
  const Budget b = error_budget(order.data, options);
  std::string ladder;
  for (const Rung& rung : b.rungs)
    if (rung.helps) ladder += fmt::format("{}{}, ", rung.choice().law->name, rung.named ? "*" : "");
  fmt::print("| {} | {:.3g} Hz | {}{:.2f} % left |\n", name, b.band.hz, ladder, 100.0 * b.rms / b.input_rms);
  std::fflush(stdout);
}

void vary(const Order& order) {
  using Options = TorqueViewOptions;
  const std::pair<const char*, double Options::*> fields[] = {{"inner_share", &Options::inner_share},
                                                              {"kernel_reach", &Options::kernel_reach},
                                                              {"rows_per_hertz", &Options::rows_per_hertz},
                                                              {"lost_step", &Options::lost_step},
                                                              {"jump", &Options::jump},
                                                              {"stuck_speed", &Options::stuck_speed},
                                                              {"stuck_quanta", &Options::stuck_quanta},
                                                              {"most_stuck", &Options::most_stuck},
                                                              {"lowest_hz", &Options::lowest_hz},
                                                              {"fewest_samples", &Options::fewest_samples},
                                                              {"most_noise", &Options::most_noise},
                                                              {"inertia_drift", &Options::inertia_drift},
                                                              {"least_inertia", &Options::least_inertia},
                                                              {"constant_speed", &Options::constant_speed},
                                                              {"block", &Options::block},
                                                              {"least_share", &Options::least_share},
                                                              {"least_low", &Options::least_low},
                                                              {"least_margin", &Options::least_margin},
                                                              {"most_left", &Options::most_left},
                                                              {"most_encoder", &Options::most_encoder},
                                                              {"last_share", &Options::last_share}};
  const std::pair<const char*, double Options::*> shares[] = {{"least_better", &Options::least_better},
                                                              {"least_leading", &Options::least_leading},
                                                              {"most_absorbed", &Options::most_absorbed},
                                                              {"same_group", &Options::same_group}};
  print_ladder("as it is", order, {});
  const auto run = [&](const char* name, double Options::*field, double value) {
    Options options;
    options.*field = value;
    print_ladder(fmt::format("`{}` {:.4g}", name, value), order, options);
  };
  for (const auto& [name, field] : fields)
    for (const double factor : {0.5, 2.0}) run(name, field, factor * (Options{}.*field));
  for (const auto& [name, field] : shares)  // of one: what is missing to it
    for (const double factor : {0.5, 2.0}) run(name, field, 1.0 - factor * (1.0 - (Options{}.*field)));
}

}  // namespace

int main(int argc, char** argv) {
  const Order order = read_order(argc, argv);
  if (order.vary) {
    vary(order);
    return 0;
  }
  const std::clock_t start = std::clock();
  const Budget budget = error_budget(order.data, order.options);
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  print_band(budget.band);
  print_rungs(budget, order.ranks);
  print_shares(budget);
  fmt::print("{:.2f} s of processor time\n", seconds);
  return 0;
}
