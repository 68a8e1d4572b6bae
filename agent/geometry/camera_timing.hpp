// When a camera exposes, and when it is given up.
#pragma once

namespace gazed::geometry {

struct CameraTiming {
  double readout_s = 0.0;  // rolling shutter: first row to last; 0: all rows at once
  double delay_s = 0.0;    // added to the driver's time stamp to give the start of exposure
  /// This long without a frame is a fault, and the camera is opened again. B-Human 2024 reopens its
  /// camera after 2000 ms.
  double timeout_s = 2.0;
};

}  // namespace gazed::geometry
