// gazed: finds the object that stands out, and says where it is.
#include <csignal>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>
#include <unistd.h>
#include <utility>
#include <variant>

#include "agent/daemon/loop.hpp"
#include "agent/daemon/process.hpp"
#include "agent/daemon/report.hpp"
#include "agent/daemon/service_manager.hpp"
#include "agent/daemon/wiring.hpp"
#include "agent/settings/options.hpp"
#include "agent/settings/settings.hpp"
#include "drivers/lcm/url.hpp"

namespace {

// Exit codes; 0: all was done, or a signal ended the run.
constexpr int ended_by_fault = 1;
constexpr int bad_configuration = 2;

int fail(int code, const char* what) {
  std::fprintf(stderr, "gazed: %s\n", what);
  return code;
}

int run(const gazed::settings::Settings& settings, const std::string& lcm_url,
        gazed::daemon::LoopParts parts, gazed::daemon::EndSignals& signals) {
  gazed::daemon::Report report(settings.run.print, stdout);
  if (const std::string warning = gazed::lcm::receive_buffer_warning(lcm_url); !warning.empty())
    report.note(warning);
  gazed::daemon::ServiceManager service(gazed::daemon::ServiceEnvironment::of_this_process(),
                                        getpid());
  for (const std::string& problem : service.problems()) report.note(problem);
  report.begin(settings, lcm_url);
  gazed::daemon::Loop loop(settings, std::move(parts), signals, report, service);
  return loop.run();
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const auto parsed = gazed::settings::parse_options(argc, argv);
    if (const auto* exit = std::get_if<gazed::settings::Exit>(&parsed)) {
      std::fputs(exit->text.c_str(), exit->code == 0 ? stdout : stderr);
      return exit->code;
    }
    const auto& options = std::get<gazed::settings::Options>(parsed);
    const gazed::settings::Settings settings = gazed::settings::load_settings(
        options.layers, gazed::daemon::scene_uncertainty, gazed::daemon::configuration_in_log);
    const std::string lcm_url = gazed::lcm::effective_lcm_url(
        settings.lcm.url, settings.camera.source.is(gazed::drivers::Origin::lcm));
    if (options.check) gazed::daemon::check_scene(settings);
    if (options.print_config) std::fputs(gazed::settings::to_toml(settings).c_str(), stdout);
    if (options.check || options.print_config) return 0;

    // A reader of our output that goes away must not leave the head turning.
    std::signal(SIGPIPE, SIG_IGN);
    // Nor must a recording that reaches the limit of a file's size end us: it stops.
    std::signal(SIGXFSZ, SIG_IGN);
    gazed::daemon::EndSignals signals;  // before a provider of liblcm's starts a thread
    gazed::daemon::LoopParts parts = gazed::daemon::make_parts(settings, lcm_url);
    return run(settings, lcm_url, std::move(parts), signals);
  } catch (const std::invalid_argument& error) {
    return fail(bad_configuration, error.what());
  } catch (const std::exception& error) {
    return fail(ended_by_fault, error.what());
  }
}
