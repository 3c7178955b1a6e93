#include "metamorphic/relations.h"

#include <fmt/format.h>

#include "gapscope/base/statistics.h"
#include "metamorphic/changes.h"

namespace gapscope::metamorphic {
namespace {

using D = ToldDrive;

constexpr double kTorqueConstant = 0.172;  ///< of the three drives [N m per unit of u]
constexpr double kDegree = kPi / 180.0;

void declare(D& d, const char* quantity, const char* unit) {
  d.reading["units"] = fmt::format("{{{}: {}}}", quantity, unit);
}

void tell_epoch(D& d, const char* unit, NumberText text) {
  declare(d, "time", unit);
  d.form.time = text;
}

void tell_positions(D& d, const char* unit, double size) {
  declare(d, "position", unit);
  write_positions(d, 1.0 / size);
}

void behind_gear(D& d, double ratio) {
  write_positions(d, ratio);
  d.encoder = fmt::format("{{quantum: {}}}", d.quantum * std::abs(ratio));
  d.reading["gear_ratio"] = fmt::format("{{position: {}}}", ratio);
}

void turn_round(D& d) { write_positions(d, -1.0), write_inputs(d, -1.0); }

void along_a_slide(D& d) {
  d.coordinates = "translation";
  d.encoder = fmt::format("{{quantum: {}}}", d.quantum);
  tell_positions(d, "mm", 1e-3);
}

void lose_some(D& d) {
  lose_rows(d, 0.01);
  d.reading["resample"] = "{rate: 2000, for: detector}";
}

// Numbers that are rounded otherwise move a reading and a fit by less than 1e-8, a diagnosis, which fits more
// than once, by less than 1e-6; where a search ends elsewhere within its last step, the row says so. `run` is
// asked of W where the numbers must be the same, of B where they need not; not of columns, as `detect` shows
// that all numbers are read to the last bit. `diagnose` is asked where what it reads beside the others (the
// held-out part, the torque, an effect) could notice, but not where it would look for a cause for a minute.
const std::vector<Relation> kRelations = {
    // units
    {"time in ms",
     [](D& d) { declare(d, "time", "ms"), write_times(d, 1e3); },
     {"ABC", equal()},
     {"W", equal()}},
    {"time as an epoch in s",
     [](D& d) { tell_epoch(d, "s", epoch_seconds); },
     {"ABC", equal()},
     {"W", equal(1e-5)}},
    {"time as an epoch in ns",
     [](D& d) { tell_epoch(d, "ns", epoch_nanoseconds); },
     {"ABC", equal()},
     {"W", equal(1e-5)},
     {"W", equal(1e-6)}},
    {"positions in deg", [](D& d) { tell_positions(d, "deg", kDegree); }, {"ABC", equal()}, {"W", equal()}},
    {"positions in rev", [](D& d) { tell_positions(d, "rev", 2.0 * kPi); }, {"ABC", equal()}, {"W", equal()}},
    {"positions in counts",
     [](D& d) { tell_positions(d, "counts", d.quantum); },
     {"ABC", equal()},
     {"W", equal()},
     {"W", equal(1e-6)}},
    {"positions in front of a gear", [](D& d) { behind_gear(d, 50.0); }, {"ABC", equal()}, {"W", equal()}},
    {"positions in front of a gear that reverses",
     [](D& d) { behind_gear(d, -1.0); },
     {"ABC", equal()},
     {"W", equal()},
     {"W", equal(1e-6)}},
    {"input in mA",
     [](D& d) { declare(d, "input", "mA"), write_inputs(d, 1e3); },
     {"ABC", equal()},
     {"W", equal()}},
    {"input as a torque",
     [](D& d) { scale(d, {.input = kTorqueConstant}); },
     {"ABC", equal()},
     {"W", equal()},
     {"W", equal(1e-6)}},
    {"along a slide in mm", along_a_slide, {"ABC", equal()}, {"W", equal()}},
    {"encoder by its counts",
     [](D& d) { d.encoder = fmt::format("{{counts: {}}}", 2.0 * kPi / d.quantum); },
     {"ABC", equal(0.0)},
     {"W", equal(0.0)}},
    {"encoder by its quantum",
     [](D& d) { d.encoder = fmt::format("{{quantum: {}}}", d.quantum); },
     {"ABC", equal(0.0)},
     {"W", equal(0.0)}},
    // offsets
    {"time + 1000 s",
     [](D& d) { shift_time(d, 1000.0); },
     {"ABC", equal()},
     {"W", equal()},
     {"W", equal(1e-6)}},
    {"time - 5 s", [](D& d) { shift_time(d, -5.0); }, {"ABC", equal()}, {"W", equal()}},
    {"position + 1000 counts",
     [](D& d) { shift_position(d, 1000.0 * d.quantum); },
     {"ABC", equal()},
     {"W", equal()},
     {"W", equal(1e-6)}},
    {"position + 0.3 counts",
     [](D& d) { shift_position(d, 0.3 * d.quantum); },
     {"ABC", equal()},
     {"W", equal()}},
    {"position + 5 turns", [](D& d) { shift_position(d, 10.0 * kPi); }, {"ABC", equal()}, {"W", equal()}},
    {"position + 1e4 rad", [](D& d) { shift_position(d, 1e4); }, {"ABC", equal()}, {"W", kWithin}},
    // sign
    {"input and position negated", turn_round, {"ABC", equal()}, {"W", equal()}, {"BC", equal(1e-6)}},
    {"input alone negated", [](D& d) { write_inputs(d, -1.0); }, {"AB", kTold}, {"B", kTold}},
    // scale; refits with other laws, which the interval holds, end where their search does
    {"a tenth of the speed",
     [](D& d) { scale(d, {.time = 10.0}); },
     {"ABC", equal()},
     {"W", equal(1e-4, 0.1)},
     {"W", kWithin}},
    {"ten times the speed", [](D& d) { scale(d, {.time = 0.1}); }, {"ABC", equal()}, {"W", equal(1e-4, 0.1)}},
    {"ten times the travel",
     [](D& d) { scale(d, {.angle = 10.0}); },
     {"ABC", equal()},
     {"W", equal()},
     {"W", equal(1e-6)}},
    {"a hundredth of the travel", [](D& d) { scale(d, {.angle = 0.01}); }, {"ABC", equal()}, {"W", equal()}},
    {"seven times the torques", [](D& d) { scale(d, {.torque = 7.0}); }, {"ABC", equal()}, {"W", equal()}},
    {"1e-4 of the torques",
     [](D& d) { scale(d, {.torque = 1e-4}); },
     {"ABC", equal()},
     {"W", equal()},
     {"BC", equal(1e-6)}},
    {"a thousand times the input", [](D& d) { scale(d, {.input = 1e3}); }, {"ABC", equal()}, {"W", equal()}},
    // order and columns
    {"parameters in another order",
     [](D& d) { d.parameters_backwards = true; },
     {"ABC", equal(0.0)},
     {"W", equal(0.0)}},
    {"a window that cuts nothing", [](D& d) { d.reading["window"] = "[-1, 100]"; }, {"ABC", equal(0.0)}, {}},
    {"more columns",
     [](D& d) {
       d.form.columns = {"t", "temperature", "u", "x1", "x2"};
     },
     {"ABC", equal(0.0)},
     {}},
    {"columns in another order",
     [](D& d) {
       d.form.columns = {"x1", "t", "u"};
     },
     {"ABC", equal(0.0)},
     {}},
    {"a decimal comma",
     [](D& d) { d.form.separator = ";", d.form.time = d.form.number = with_comma; },
     {"ABC", equal(0.0)},
     {"W", equal(0.0)}},
    {"tabs and CRLF",
     [](D& d) { d.form.separator = "\t", d.form.line_end = "\r\n"; },
     {"ABC", equal(0.0)},
     {}},
    {"exponents", [](D& d) { d.form.time = d.form.number = in_exponents; }, {"ABC", equal(0.0)}, {}},
    {"rows reversed", reverse_rows, {"ABC", equal(0.0)}, {"B", equal(0.0)}, {}},
    {"rows shuffled", shuffle_rows, {"ABC", kRefused}, {"B", kRefused}, {"B", kRefused}},
    // an effect of no amount
    {"no friction in the model",
     [](D& d) { d.effects = "[{motor_coulomb_friction: {level_nm: 0}}]"; },
     {"ABC", equal(0.0)},
     {"W", kWithin},
     {"W", kWithin}},
    // halves and copies
    {"the first half", [](D& d) { keep_part(d, 0.0, 0.5); }, {"AW", kWithin}, {"W", kWithin}},
    {"the second half", [](D& d) { keep_part(d, 0.5, 1.0); }, {"AW", kWithin}, {"W", kWithin}},
    {"both halves as two files", split, {"AW", kWithin}, {"W", kWithin}, {"W", kWithin}},
    {"two files in another order",
     [](D& d) { split(d), swap_order(d); },
     {"AW", equal_but_first()},
     {"W", equal_but_first(1e-6)},
     {},
     false,
     split},
    {"held out instead of fitted",
     [](D& d) { hold_out_second_half(d), swap_held_out(d); },
     {},
     {},
     {"W", kWithin},
     false,
     hold_out_second_half},
    {"the end once more", [](D& d) { repeat_end(d, 3.0); }, {"A", kWithin}, {}},
    // rows that are not as the drive gave them
    {"1 % of the rows lost", lose_some, {"B", kTold}, {"W", kWithin}, {"B", kTold}},
    {"input a row early", [](D& d) { move_input(d, -1); }, {"AB", kTold}, {"B", kTold}, {"B", kTold}},
    {"input a row late", [](D& d) { move_input(d, 1); }, {"AB", kTold}, {"B", kTold}},
    {"every second row", [](D& d) { take_every(d, 2); }, {"ABC", kTold}, {"B", kTold}, {"W", kTold}},
    {"every third row", [](D& d) { take_every(d, 3); }, {"ABC", kTold}, {"B", kTold}},
    {"every fifth row", [](D& d) { take_every(d, 5); }, {"ABC", kTold}, {"B", kTold}},
    {"every tenth row", [](D& d) { take_every(d, 10); }, {"AB", kTold}, {"B", kTold}},
    {"every row twice",
     [](D& d) { insert_rows(d, 2, Between::kHeld, Between::kHeld); },
     {"ABC", kTold},
     {"B", kTold},
     {"B", kTold},
     true},
    {"every row twice, a line of inputs",
     [](D& d) { insert_rows(d, 2, Between::kLine, Between::kHeld); },
     {"ABC", kTold},
     {"B", kTold},
     {"B", kTold},
     true},
    {"every row three times",
     [](D& d) { insert_rows(d, 3, Between::kHeld, Between::kHeld); },
     {"ABC", kTold},
     {"B", kTold},
     {},
     true},
    {"positions held over 2 rows",
     [](D& d) { hold_positions(d, 2); },
     {"ABC", kTold},
     {"B", kTold},
     {"B", kTold},
     true},
    {"positions held over 3 rows",
     [](D& d) { hold_positions(d, 3); },
     {"ABC", kTold},
     {"B", kTold},
     {},
     true},
    {"positions held over 4 rows",
     [](D& d) { hold_positions(d, 4); },
     {"ABC", kTold},
     {"B", kTold},
     {"B", kTold},
     true},
    {"an interpolated row for each",
     [](D& d) { insert_rows(d, 2, Between::kLine, Between::kLine); },
     {"ABC", kTold},
     {"B", kTold},
     {"B", kTold},
     true},
    {"two interpolated rows for each",
     [](D& d) { insert_rows(d, 3, Between::kLine, Between::kLine); },
     {"ABC", kTold},
     {"B", kTold},
     {},
     true},
};

}  // namespace

std::span<const Relation> relations() { return kRelations; }

}  // namespace gapscope::metamorphic
