// gazed: finds the object that stands out, and says where it is.
#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <malloc.h>
#include <stdexcept>
#include <string>
#include <string_view>
#include <unistd.h>
#include <utility>
#include <variant>

#include "agent/base/text.hpp"
#include "agent/daemon/loop.hpp"
#include "agent/daemon/process.hpp"
#include "agent/daemon/report.hpp"
#include "agent/daemon/service_manager.hpp"
#include "agent/daemon/wiring.hpp"
#include "agent/settings/doubts.hpp"
#include "agent/settings/options.hpp"
#include "agent/settings/settings.hpp"
#include "drivers/lcm/url.hpp"

namespace gazed {
namespace {

// Exit codes; 0: all was done, or a signal ended the run.
constexpr int ended_by_fault = 1;
constexpr int bad_configuration = 2;

int fail(int code, const char* what) {
  std::fprintf(stderr, "gazed: %s\n", what);
  return code;
}

/// Prints a text that the user asked for. A full disk must not look like success.
int print(const std::string& text) {
  if (std::fputs(text.c_str(), stdout) >= 0 && std::fflush(stdout) == 0) return 0;
  return fail(ended_by_fault, base::text("cannot write: %s", std::strerror(errno)).c_str());
}

/// How the service manager says the previous gazed ended (systemd.exec(5)); without a manager,
/// whoever asks knows. A gazed that ended by itself has already released the head.
bool was_killed() {
  const char* result = std::getenv("SERVICE_RESULT");
  constexpr std::array<std::string_view, 5> killed{"signal", "core-dump", "watchdog", "timeout",
                                                   "oom-kill"};
  return result == nullptr || std::ranges::find(killed, result) != killed.end();
}

int check(const settings::Settings& settings, const settings::Options& options) {
  daemon::check_parts(settings);
  for (const std::string& doubt : settings::doubts(settings))
    std::fprintf(stderr, "gazed: %s\n", doubt.c_str());
  // When the configuration is printed, standard output contains nothing else.
  if (options.print_config) return 0;
  return print(daemon::what_was_checked(settings, options.layers.file) + '\n');
}

int run(const settings::Settings& settings, const std::string& lcm_url, daemon::LoopParts parts,
        daemon::EndSignals& signals) {
  daemon::Report report(settings.run.print, stdout);
  if (const std::string warning = lcm::receive_buffer_warning(lcm_url); !warning.empty())
    report.note(warning);
  for (const std::string& doubt : settings::doubts(settings)) report.note(doubt);
  daemon::ServiceManager service(daemon::ServiceEnvironment::of_this_process(), getpid());
  for (const std::string& problem : service.problems()) report.note(problem);
  report.begin(settings, lcm_url);
  daemon::Loop loop(settings, std::move(parts), signals, report, service);
  malloc_trim(0);  // give back the memory that reading the configuration needed
  const int code = loop.run();
  return code == 0 && report.lost_output() ? ended_by_fault : code;
}

int gazed_main(int argc, char** argv) {
  const auto parsed = settings::parse_options(argc, argv);
  if (const auto* exit = std::get_if<settings::Exit>(&parsed)) {
    if (exit->code == 0) return print(exit->text);
    std::fputs(exit->text.c_str(), stderr);
    return exit->code;
  }
  const auto& options = std::get<settings::Options>(parsed);
  const settings::Settings settings = settings::load_settings(
      options.layers, daemon::scene_uncertainty, daemon::configuration_in_log);
  const std::string lcm_url =
      lcm::effective_lcm_url(settings.lcm.url, settings.camera.source.is(drivers::Origin::lcm));
  int code = options.check ? check(settings, options) : 0;
  if (code == 0 && options.print_config) code = print(settings::to_toml(settings));
  if (options.check || options.print_config) return code;

  if (options.release_head) {
    if (!was_killed()) return 0;
    const std::string trouble = daemon::release_head(settings);
    return trouble.empty() ? 0 : fail(ended_by_fault, ("the head is not limp: " + trouble).c_str());
  }

  // A reader of our output that exits must not leave the head turning.
  std::signal(SIGPIPE, SIG_IGN);
  // Nor may an output file that reaches the size limit.
  std::signal(SIGXFSZ, SIG_IGN);
  daemon::EndSignals signals;  // before a provider of liblcm starts a thread
  daemon::LoopParts parts = daemon::make_parts(settings, lcm_url);
  return run(settings, lcm_url, std::move(parts), signals);
}

}  // namespace
}  // namespace gazed

int main(int argc, char** argv) {
  try {
    return gazed::gazed_main(argc, argv);
  } catch (const std::invalid_argument& error) {
    return gazed::fail(gazed::bad_configuration, error.what());
  } catch (const std::exception& error) {
    return gazed::fail(gazed::ended_by_fault, error.what());
  }
}
