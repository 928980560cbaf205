#include "cases/program/session/terminal/log.h"

#include "cases/program/session/terminal/message_text.h"
#include "physics/error.h"

#include <fmt/format.h>
#include <spdlog/logger.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/ostream_sink.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <sstream>
#include <vector>

namespace pfdm {

struct Log::Sinks {
  std::ostream& stream;
  std::ostream& errors;
  bool terminal = false;
  bool quiet = false;
  bool progress_shown = false;
  std::shared_ptr<spdlog::logger> console;
  std::shared_ptr<spdlog::logger> file;  // null until open_file()
  std::vector<std::string> said_before;  // for the file, when it is opened
  std::vector<std::string> warnings;
};

Log::Log(std::ostream& console, std::ostream& errors, bool terminal, bool quiet)
    : sinks_(std::make_unique<Sinks>(Sinks{console, errors, terminal, quiet, false, nullptr, nullptr, {}, {}})) {
  auto sink = std::make_shared<spdlog::sinks::ostream_sink_mt>(console, true);
  sinks_->console = std::make_shared<spdlog::logger>("console", sink);
  sinks_->console->set_pattern("%v");
  if (quiet) sinks_->console->set_level(spdlog::level::off);
}

Log::~Log() { clear_progress(); }

std::unique_ptr<Log> Log::with_own_file() const {
  return std::make_unique<Log>(sinks_->stream, sinks_->errors, sinks_->terminal, sinks_->quiet);
}

void Log::open_file(const std::filesystem::path& file, bool append) {
  std::error_code ignored;  // a link is replaced: what it points to is not this program's to write to
  if (!append || std::filesystem::is_symlink(file, ignored)) std::filesystem::remove(file, ignored);
  try {
    auto sink = std::make_shared<spdlog::sinks::basic_file_sink_mt>(file.string(), !append);
    sinks_->file = std::make_shared<spdlog::logger>("file", sink);
  } catch (const spdlog::spdlog_ex& error) {
    throw ComputationError(fmt::format("{} cannot be written: {}", file.string(), error.what()));
  }
  sinks_->file->set_pattern("%Y-%m-%d %H:%M:%S %v");
  sinks_->file->flush_on(spdlog::level::info);
  sinks_->file->set_error_handler([name = file.string()](const std::string& what) {
    throw ComputationError(fmt::format("{} cannot be written: {}", name, what));
  });
  for (const std::string& message : sinks_->said_before) sinks_->file->info(message);
  sinks_->said_before.clear();
}

void Log::to_file(const std::string& message) {
  if (sinks_->file)
    sinks_->file->info(message);
  else
    sinks_->said_before.push_back(message);
}

void Log::say(const std::string& message) {
  clear_progress();
  sinks_->console->info(message);
  to_file(message);
}

const std::vector<std::string>& Log::warnings() const { return sinks_->warnings; }

void Log::say_lines(const std::string& text, const std::string& indent) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) say(indent + line);
}

void Log::warn(const std::string& given) {
  const std::string message = message_text(given);
  if (std::ranges::find(sinks_->warnings, message) == sinks_->warnings.end()) sinks_->warnings.push_back(message);
  say(fmt::format("warning: {}", message));
  if (sinks_->quiet) sinks_->errors << "pfdm: warning: " << message << std::endl;
}

void Log::step(const std::string& line) {
  if (!sinks_->terminal) sinks_->console->info(line);
  to_file(line);
}

void Log::progress(const std::string& line) {
  if (!sinks_->terminal || sinks_->quiet) return;
  sinks_->stream << '\r' << line.substr(0, static_cast<std::size_t>(columns())) << "\x1b[K" << std::flush;
  sinks_->progress_shown = true;
}

int Log::columns() const {
  constexpr int usual = 80;
  winsize size{};
  const bool known = ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1;
  return (known ? size.ws_col : usual) - 1;
}

void Log::clear_progress() {
  if (sinks_->progress_shown) sinks_->stream << "\r\x1b[K" << std::flush;
  sinks_->progress_shown = false;
}

}  // namespace pfdm
