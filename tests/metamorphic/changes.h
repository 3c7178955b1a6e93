#pragma once

#include <cstddef>
#include <string>

#include "metamorphic/told_drive.h"

/// Ways to tell a drive otherwise. Each changes all of its recordings alike.
namespace gapscope::metamorphic {

void shift_time(ToldDrive& drive, double by);                  ///< [s]
void shift_position(ToldDrive& drive, double by);              ///< [rad]
void write_times(ToldDrive& drive, double times);              ///< t only
void write_inputs(ToldDrive& drive, double times);             ///< u only
void write_positions(ToldDrive& drive, double times);          ///< x1 only
void scale_parameter(ToldDrive& drive, int place, double by);  ///< of the model
void move_input(ToldDrive& drive, int rows);                   ///< later by so many rows; earlier: < 0

void reverse_rows(ToldDrive& drive);
void shuffle_rows(ToldDrive& drive);
void lose_rows(ToldDrive& drive, double share);
void take_every(ToldDrive& drive, std::size_t nth);       ///< row, the others are left out
void hold_positions(ToldDrive& drive, std::size_t rows);  ///< x1 is read anew every so many rows

/// What stands in the rows that come between two.
enum class Between { kHeld, kLine };

/// As many times the rows at as many times the rate.
void insert_rows(ToldDrive& drive, std::size_t times, Between input, Between position);

/// Recordings are cut in two: the parts are fitted, or the second one is held out.
void keep_part(ToldDrive& drive, double from, double to);  ///< shares of its rows
void split(ToldDrive& drive);
void swap_order(ToldDrive& drive);
void hold_out_second_half(ToldDrive& drive);
void swap_held_out(ToldDrive& drive);

/// The last `duration` [s], a whole number of periods, once more behind the end.
void repeat_end(ToldDrive& drive, double duration);

/// Number texts of a CSV.
std::string with_comma(double value);         ///< "0,25"
std::string in_exponents(double value);       ///< "2.5000000000000000e-01"
std::string epoch_seconds(double seconds);    ///< since 1970, of a recording of 2023
std::string epoch_nanoseconds(double value);  ///< the same, whole

}  // namespace gapscope::metamorphic
