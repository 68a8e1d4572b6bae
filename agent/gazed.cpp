// gazed: finds the object that stands out, and says where it is.
#include <csignal>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <unistd.h>
#include <variant>

#include "agent/loop.hpp"
#include "agent/process.hpp"
#include "agent/report.hpp"
#include "agent/service_manager.hpp"
#include "agent/settings/options.hpp"
#include "agent/settings/settings.hpp"
#include "agent/wiring.hpp"
#include "drivers/lcm/url.hpp"

namespace {

// The exit codes of DESIGN 4.1.
constexpr int ended_by_fault = 1;
constexpr int bad_configuration = 2;

int fail(int code, const char* what) {
  std::fprintf(stderr, "gazed: %s\n", what);
  return code;
}

int run(const gazed::Settings& settings, const std::string& lcm_url, gazed::LoopParts parts,
        gazed::EndSignals& signals) {
  gazed::Report report(settings.run.print, stdout);
  if (const std::string warning = gazed::receive_buffer_warning(lcm_url); !warning.empty())
    report.note(warning);
  gazed::ServiceManager service(gazed::ServiceEnvironment::of_this_process(), getpid());
  for (const std::string& problem : service.problems()) report.note(problem);
  report.begin(settings, lcm_url);
  const gazed::CycleSettings cycle = gazed::cycle_settings(settings, parts.head->obeys());
  gazed::Loop loop(settings, cycle, std::move(parts), signals, report, service);
  return loop.run();
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const auto parsed = gazed::parse_options(argc, argv);
    if (const auto* exit = std::get_if<gazed::Exit>(&parsed)) {
      std::fputs(exit->text.c_str(), exit->code == 0 ? stdout : stderr);
      return exit->code;
    }
    const auto& options = std::get<gazed::Options>(parsed);
    const gazed::Settings settings =
        gazed::load_settings(options.layers, gazed::scene_uncertainty, gazed::configuration_in_log);
    const std::string lcm_url =
        gazed::effective_lcm_url(settings.lcm.url, settings.camera.source == "lcm");
    if (options.check) gazed::check_scene(settings);
    if (options.print_config) std::fputs(gazed::to_toml(settings).c_str(), stdout);
    if (options.check || options.print_config) return 0;

    // A reader of our output that goes away must not leave the head turning.
    std::signal(SIGPIPE, SIG_IGN);
    // Nor must a recording that reaches the limit of a file's size end us: it stops.
    std::signal(SIGXFSZ, SIG_IGN);
    gazed::EndSignals signals;  // before liblcm starts its thread
    gazed::LoopParts parts = gazed::make_parts(settings, lcm_url);
    return run(settings, lcm_url, std::move(parts), signals);
  } catch (const std::invalid_argument& error) {
    return fail(bad_configuration, error.what());
  } catch (const std::exception& error) {
    return fail(ended_by_fault, error.what());
  }
}
