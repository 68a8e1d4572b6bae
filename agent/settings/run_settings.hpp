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

/// What is sent of the frames: nothing, their pixels, or a JPEG file of each.
enum class PublishedImages : std::uint8_t { none, pixels, jpeg };

struct PublishSettings {
  PublishedImages images = PublishedImages::none;
  int jpeg_quality = 80;           // 1 to 100
  double images_per_second = 0.0;  // the most; 0: all
  bool saliency = true;
};

}  // namespace gazed::settings
