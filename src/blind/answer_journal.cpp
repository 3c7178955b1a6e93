#include "blind/answer_journal.h"

#include <unistd.h>

#include <filesystem>
#include <stdexcept>

#include "base/input_file.h"
#include "base/move_file.h"
#include "base/shown.h"
#include "gapscope/base/errors.h"
#include "gapscope/base/whole_file.h"
#include "results/blind_files.h"
#include "results/sha256.h"

namespace gapscope::blind {
namespace {

std::string head_of(const std::string& check) { return "gapscope.answers_so_far/2, " + check; }

}  // namespace

AnswerJournal::AnswerJournal(std::string path, const std::string& check) : path_(std::move(path)) {
  require_alone();
  const std::string found = content_identity(path_);
  read(check);
  const std::string whole = new_file_beside(path_);
  out_.open(whole, std::ios::binary);
  lock_.emplace(whole);
  const std::string head = head_of(check);
  out_ << head << '\n';
  chain_ = sha256(head);
  for (const auto& [name, answer] : answers_) write(answer);
  if (!out_.flush()) {
    unlink(whole.c_str());
    throw std::runtime_error(path_ + ": cannot be written");
  }
  replace_file(found, whole, path_);
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
  std::ifstream in = try_input_file(path_);
  std::string line;
  const auto require_read = [&] {
    if (!in.is_open() || in.bad()) throw MachineError(path_ + ": cannot be read");
  };
  const bool begun = static_cast<bool>(std::getline(in, line));
  require_read();
  const std::string head = head_of(check);
  if (!begun || line != head)
    throw ConfigError(
        path_, 1,
        "begins with " + shown(line, 200) + ", expected " + shown(head, 200) + "; remove it to start again");
  chain_ = sha256(head);
  for (int number = 2; std::getline(in, line) && !in.eof(); ++number) take(line, number);
  require_read();  // or answers that are there would be given again
}

void AnswerJournal::take(const std::string& line, int number) {
  const std::size_t end = line.find(' ');
  const std::string text = end == line.npos ? "" : line.substr(end + 1);
  chain_ = sha256(chain_ + "\n" + text + "\n");
  if (line.substr(0, end) != chain_)
    throw ConfigError(path_, number,
                      "is not as it was written, or follows another line than it did, expected it and those "
                      "before it unchanged; remove the file to start again");
  const BlindAnswer answer = blind_answer_of(text, path_ + ":" + std::to_string(number));
  if (!answers_.emplace(answer.name, answer).second)
    throw ConfigError(path_, number,
                      "answers " + shown(answer.name) + " again, expected one answer to each case");
}

void AnswerJournal::write(const BlindAnswer& answer) {
  const std::string text = line_of(answer);
  chain_ = sha256(chain_ + "\n" + text + "\n");
  out_ << chain_ + ' ' + text + '\n';
}

void AnswerJournal::add(const BlindAnswer& answer) {
  const std::lock_guard lock(adding_);
  write(answer);
  if (!out_.flush()) throw std::runtime_error(path_ + ": cannot be written");
  answers_.insert_or_assign(answer.name, answer);
}

void AnswerJournal::remove() {
  out_.close();
  const std::string found = content_identity(path_);
  std::error_code gone;
  if (std::filesystem::equivalent("/proc/self/fd/" + std::to_string(lock_->handle()), path_, gone))
    remove_file(found, path_);
}

}  // namespace gapscope::blind
