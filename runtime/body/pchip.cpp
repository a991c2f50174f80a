#include "runtime/body/pchip.hpp"

#include <algorithm>

namespace garment::body {

Pchip::Pchip(std::vector<double> x, std::vector<double> y) : x_(std::move(x)), y_(std::move(y)) {
  std::size_t n = x_.size();
  slope_.assign(n, 0);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    double h0 = x_[i] - x_[i - 1], h1 = x_[i + 1] - x_[i];
    double d0 = (y_[i] - y_[i - 1]) / h0, d1 = (y_[i + 1] - y_[i]) / h1;
    if (d0 * d1 <= 0) continue;  // an extreme: flat
    double w0 = 2 * h1 + h0, w1 = h1 + 2 * h0;
    slope_[i] = (w0 + w1) / (w0 / d0 + w1 / d1);
  }
  if (n >= 2) {
    slope_[0] = (y_[1] - y_[0]) / (x_[1] - x_[0]);
    slope_[n - 1] = (y_[n - 1] - y_[n - 2]) / (x_[n - 1] - x_[n - 2]);
  }
}

double Pchip::operator()(double x) const {
  if (x <= x_.front()) return y_.front();
  if (x >= x_.back()) return y_.back();
  std::size_t i = static_cast<std::size_t>(std::upper_bound(x_.begin(), x_.end(), x) - x_.begin()) - 1;
  double h = x_[i + 1] - x_[i], t = (x - x_[i]) / h, u = 1 - t;
  return u * u * ((1 + 2 * t) * y_[i] + t * h * slope_[i]) +
         t * t * ((3 - 2 * t) * y_[i + 1] - u * h * slope_[i + 1]);
}

}  // namespace garment::body
