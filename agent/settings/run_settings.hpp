// What the program as a whole is told: how long it runs, what it prints, records and publishes.
#pragma once

#include <cstdint>
#include <string>

namespace gazed::settings {

enum class PrintFormat : std::uint8_t { text, json, none };

struct RunSettings {
  int fixations = 0;  // end after this many; 0: never
  PrintFormat print = PrintFormat::text;
  // Log file that every consumed frame and head state goes to, and every fixation; empty: none.
  std::string record;
  double record_keep_bytes = 0.0;  // of it and of those before it; 0: all are kept
};

struct PublishSettings {
  bool images = false;
  bool saliency = true;
};

}  // namespace gazed::settings
