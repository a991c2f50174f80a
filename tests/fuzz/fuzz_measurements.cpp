// Any bytes as a measurement file: it is read, or refused with a code; values are finite.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "runtime/io/measurements_xml.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  for (const garment::io::MeasurementOptions& options :
       {garment::io::MeasurementOptions{}, garment::io::MeasurementOptions{0.5, 1.76}}) {
    const garment::io::MeasurementsResult read = garment::io::read_measurements(text, options, "fuzz", {});
    if (read.measurements.has_value() == garment::has_errors(read.findings)) std::abort();
    if (read.measurements)
      for (const garment::io::Measurement& m : *read.measurements)
        if (!std::isfinite(m.value)) std::abort();
  }
  return 0;
}
