#include "blind/answer_journal.h"

#include <filesystem>
#include <stdexcept>

#include "gapscope/base/errors.h"
#include "gapscope/base/move_file.h"
#include "gapscope/base/shown.h"
#include "gapscope/base/whole_file.h"
#include "gapscope/results/blind_files.h"

namespace gapscope::blind {

AnswerJournal::AnswerJournal(std::string path, const std::string& check) : path_(std::move(path)) {
  require_alone();
  const std::string found = content_identity(path_);
  read(check);
  const std::string whole = new_file_beside(path_);
  out_.open(whole, std::ios::binary);
  lock_.emplace(whole);
  out_ << check << '\n';
  for (const auto& [name, answer] : answers_) out_ << line_of(answer) << '\n';
  try {
    if (!out_.flush()) throw std::runtime_error(path_ + ": cannot be written");
    replace_file(found, whole, path_);
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove(whole, ignored);
    throw;
  }
}

void AnswerJournal::require_alone() const {
  if (ProcessLock(path_).held_by_another())
    throw ConfigError(path_, "is being written by another process, expected one at a time");
}

void AnswerJournal::read(const std::string& check) {
  std::error_code ignored;
  const auto there = std::filesystem::symlink_status(path_, ignored);
  if (!std::filesystem::exists(there)) return;
  if (!std::filesystem::is_regular_file(there))
    throw ConfigError(path_, "is no regular file, expected the answers so far");
  std::ifstream in(path_, std::ios::binary);
  std::string line;
  const auto require_read = [&] {
    if (!in.is_open() || in.bad()) throw MachineError(path_ + ": cannot be read");
  };
  const bool begun = static_cast<bool>(std::getline(in, line));
  require_read();
  if (!begun || line != check)
    throw ConfigError(
        path_, 1,
        "answers " + shown(line, 200) + ", expected " + shown(check, 200) + "; remove it to begin anew");
  for (int number = 2; std::getline(in, line) && !in.eof(); ++number) {
    BlindAnswer answer = blind_answer_of(line, path_ + ":" + std::to_string(number));
    answers_.insert_or_assign(answer.name, answer);
  }
  require_read();  // or answers that are there would be given again
}

void AnswerJournal::add(const BlindAnswer& answer) {
  const std::string line = line_of(answer) + '\n';
  const std::lock_guard lock(adding_);
  out_ << line;
  if (!out_.flush()) throw std::runtime_error(path_ + ": cannot be written");
  answers_.insert_or_assign(answer.name, answer);
}

void AnswerJournal::remove() {
  out_.close();
  std::error_code gone;
  if (std::filesystem::equivalent("/proc/self/fd/" + std::to_string(lock_->handle()), path_, gone))
    std::filesystem::remove(path_);
}

}  // namespace gapscope::blind
