#include "recording/log_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>

#include "base/shown.h"
#include "gapscope/base/errors.h"
#include "recording/limits.h"

namespace gapscope::internal::recording {
namespace {

constexpr const char *kTime = "t", *kStamp = "stamp", *kLogged = "log_time", *kPublished = "publish_time";

/// A topic may have channels of several types: each has its own.
struct ChannelReader {
  LogChannel channel;
  std::unique_ptr<MessageReader> reader;

  bool reads(const LogChannel& c) const {
    return c.encoding == channel.encoding && c.type == channel.type && c.definition == channel.definition;
  }
};

/// What is known of a topic before a column is asked for.
struct Topic {
  std::vector<ChannelReader> readers;
  std::string flaw;  ///< why its messages are not read
  std::set<std::string> names;
  std::size_t looked_at = 0;

  /// @throws DamagedBytes for a channel that is not read
  const MessageReader& reader_for(const LogChannel& c) {
    constexpr std::size_t kMostTypes = 100;
    for (const ChannelReader& r : readers)
      if (r.reads(c)) return *r.reader;
    if (readers.size() == kMostTypes)
      throw DamagedBytes{0, fmt::format("has messages of more than {} types, expected fewer", kMostTypes)};
    readers.push_back({c, reader_of(c)});
    return *readers.back().reader;
  }
};

/// Of times [ns] that may be anything.
double seconds_between(std::int64_t from, std::int64_t to) {
  const auto difference = static_cast<std::uint64_t>(to) - static_cast<std::uint64_t>(from);
  return static_cast<double>(static_cast<std::int64_t>(difference)) / 1e9;
}

class LogFile : public ArrayFile {
 public:
  LogFile(std::string path, std::unique_ptr<MessageLog> log, const std::string& position)
      : path_(std::move(path)), log_(std::move(log)) {
    look();
    if (position.empty()) return;  // only names are asked for
    choose(position);
    count();
  }

  const char* noun() const override { return "column"; }
  const char* row() const override { return "message"; }

  std::optional<StoredArray> find(const std::string& name) override {
    if (topic_.empty()) return {};
    const std::string own = without_topic(name);
    if (!is_time(own) && !topics_.at(topic_).names.contains(own)) return {};
    return StoredArray{name, "", {messages_}};
  }

  std::vector<std::string> names() override {
    std::vector<std::string> all = {kTime, kStamp, kLogged, kPublished};
    for (const auto& [topic, content] : topics_) {
      if (topic_.empty() || topic == topic_)
        all.insert(all.end(), content.names.begin(), content.names.end());
      for (const std::string& own : content.names)
        if (topic_.empty()) all.push_back(topic + "/" + own);
    }
    return all;
  }

  std::vector<double> numbers(const std::string& name, std::size_t) override {
    const std::string own = without_topic(name);
    std::vector<double> values;
    std::int64_t first = 0;
    each([&](const LogMessage& m, const MessageNumbers& numbers) {
      if (is_time(own)) {
        const std::int64_t at = time_of(own, m, numbers);
        if (values.empty()) first = at;
        values.push_back(seconds_between(first, at));
        return;
      }
      const double* const value = numbers.find(own);
      if (!value)
        throw ConfigError(path_,
                          fmt::format("message {} of {} has no {}, expected it in every one that has {}",
                                      values.size() + 1, topic_, shown(own), shown(position_)));
      values.push_back(*value);
    });
    return values;
  }

 private:
  static bool is_time(const std::string& name) {
    return name == kTime || name == kStamp || name == kLogged || name == kPublished;
  }

  std::int64_t time_of(const std::string& name, const LogMessage& m, const MessageNumbers& numbers) const {
    if (name == kStamp || (name == kTime && stamped_)) return numbers.stamp();
    return name == kPublished ? m.published : m.logged;
  }

  std::string without_topic(const std::string& name) const {
    const std::string before = topic_ + "/";
    return name.starts_with(before) ? name.substr(before.size()) : name;
  }

  /// Takes a message of a topic that is read apart.
  void take_apart(const LogMessage& m, Topic& topic, MessageNumbers& numbers, std::size_t which) const {
    numbers.clear();
    try {
      topic.reader_for(*m.channel).read(m.bytes, numbers);
      numbers.finish();
    } catch (const DamagedBytes& damaged) {
      throw ConfigError(path_, fmt::format("message {} of {} {} (at its byte {})", which, m.channel->topic,
                                           damaged.what, damaged.at));
    }
  }

  /// What each topic has, from its first messages.
  void look() {
    constexpr std::size_t kEnough = 200, kMostTopics = 10'000;
    MessageNumbers numbers;
    log_->for_each([&](const LogMessage& m) {
      Topic& topic = topics_[m.channel->topic];
      if (topics_.size() > kMostTopics)
        throw ConfigError(path_, fmt::format("has more than {} topics, expected fewer", kMostTopics));
      if (!topic.flaw.empty() || ++topic.looked_at > kEnough) return;
      try {
        const MessageReader& reader = topic.reader_for(*m.channel);
        numbers.clear();
        reader.read(m.bytes, numbers);
        numbers.finish();
        for (const auto& [name, value] : numbers.all()) topic.names.insert(name);
      } catch (const DamagedBytes& damaged) {
        if (topic.names.empty()) topic.flaw = damaged.what;  // else it is told where it is read
      }
    });
  }

  void choose(const std::string& position) {
    std::vector<std::string> having, flawed;
    for (const auto& [name, topic] : topics_) {
      const std::string own = position.starts_with(name + "/") ? position.substr(name.size() + 1) : position;
      if (topic.flaw.empty() && topic.names.contains(own)) having.push_back(name), position_ = own;
      if (!topic.flaw.empty()) flawed.push_back(fmt::format("{} {}", name, topic.flaw));
    }
    if (having.size() == 1) {
      topic_ = having.front();
      return;
    }
    if (!having.empty())
      throw ConfigError(
          path_, fmt::format("has {} in the topics {}, expected the one that is meant before it: {}/{}",
                             shown(position), fmt::join(having, ", "), having.front(), position));
    throw ConfigError(
        path_, fmt::format("has no {} among {}{}, expected it with its topic or without", shown(position),
                           some_names(), flawed.empty() ? "" : "; " + flawed.front()));
  }

  std::string some_names() const {
    constexpr std::size_t kMost = 12;
    std::vector<std::string> some;
    for (const auto& [name, topic] : topics_)
      for (const std::string& own : topic.names)
        if (some.size() < kMost && !own.starts_with("header.")) some.push_back(shown(name + "/" + own));
    return some.empty() ? "no numbers at all" : fmt::format("{}", fmt::join(some, ", "));
  }

  /// Calls for every message that is a sample.
  template <class Take>
  void each(Take take) {
    Topic& topic = topics_.at(topic_);
    MessageNumbers numbers;
    std::size_t which = 0;
    log_->for_each([&](const LogMessage& m) {
      if (m.channel->topic != topic_) return;
      take_apart(m, topic, numbers, ++which);
      if (numbers.find(position_)) take(m, numbers);
    });
  }

  void count() {
    stamped_ = true;
    each([&](const LogMessage&, const MessageNumbers& numbers) {
      if (++messages_ > kMostSamples)
        throw ConfigError(path_, fmt::format("has more than {} messages, expected fewer", kMostSamples));
      stamped_ &= numbers.stamp() != 0;
    });
  }

  std::string path_;
  std::unique_ptr<MessageLog> log_;
  std::map<std::string, Topic> topics_;
  std::string topic_, position_;  ///< that is read; its position, without the topic
  std::size_t messages_ = 0;
  bool stamped_ = false;
};

}  // namespace

std::unique_ptr<ArrayFile> log_columns(const std::string& path, std::unique_ptr<MessageLog> log,
                                       const RecordingColumns& columns) {
  return std::make_unique<LogFile>(path, std::move(log), columns.position);
}

}  // namespace gapscope::internal::recording
