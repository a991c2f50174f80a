#include "runtime/io/svg_path.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "runtime/base/portable_math.hpp"

namespace garment::io {
namespace {

constexpr double kFarthest = 1e9;  // user units
constexpr double kPi = portable::kPi;

class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) {}

  void blanks() {
    while (!text_.empty() && (text_[0] == ' ' || text_[0] == ',' || text_[0] == '\t' || text_[0] == '\n' ||
                              text_[0] == '\r' || text_[0] == '\f'))
      text_.remove_prefix(1);
  }
  bool empty() {
    blanks();
    return text_.empty();
  }
  char letter() {
    blanks();
    if (text_.empty() || !((text_[0] >= 'a' && text_[0] <= 'z') || (text_[0] >= 'A' && text_[0] <= 'Z')))
      return 0;
    const char c = text_[0];
    text_.remove_prefix(1);
    return c;
  }
  bool number(double& value) {
    blanks();
    std::string_view t = text_;
    if (!t.empty() && t[0] == '+') t.remove_prefix(1);
    const auto [end, error] =
        std::from_chars(t.data(), t.data() + t.size(), value, std::chars_format::general);
    if (error != std::errc() || !(std::fabs(value) <= kFarthest)) return false;
    text_.remove_prefix(static_cast<std::size_t>(end - text_.data()));
    return true;
  }
  /// A flag of an arc: one digit, which need not be set off.
  bool flag(bool& value) {
    blanks();
    if (text_.empty() || (text_[0] != '0' && text_[0] != '1')) return false;
    value = text_[0] == '1';
    text_.remove_prefix(1);
    return true;
  }
  bool take(char c) {
    blanks();
    if (text_.empty() || text_[0] != c) return false;
    text_.remove_prefix(1);
    return true;
  }
  std::string_view word() {
    blanks();
    std::size_t n = 0;
    while (n < text_.size() && ((text_[n] >= 'a' && text_[n] <= 'z') || (text_[n] >= 'A' && text_[n] <= 'Z')))
      ++n;
    const std::string_view out = text_.substr(0, n);
    text_.remove_prefix(n);
    return out;
  }

 private:
  std::string_view text_;
};

double angle_between(const Point2& u, const Point2& v) {
  return portable::atan2(u.x() * v.y() - u.y() * v.x(), u.dot(v));
}

/// Cubics of at most a quarter turn for an arc of an ellipse.
void add_elliptical(std::vector<Curve>& out, const Point2& centre, const Eigen::Matrix2d& axes, double from,
                    double turn, const Point2& end) {
  const int n = std::max(1, static_cast<int>(std::ceil(std::fabs(turn) / (kPi / 2) - 1e-9)));
  const double step = turn / n, handle = 4.0 / 3 * portable::sin(step / 4) / portable::cos(step / 4);
  auto at = [&](double a) { return Point2(centre + axes * Point2(portable::cos(a), portable::sin(a))); };
  auto along = [&](double a) { return Point2(axes * Point2(-portable::sin(a), portable::cos(a))); };
  Point2 p = out.empty() ? at(from) : out.back().end();
  for (int k = 0; k < n; ++k) {
    const double a = from + k * step, b = a + step;
    const Point2 q = k + 1 == n ? end : at(b);
    out.emplace_back(p, q, geometry::Cubic{p + handle * along(a), q - handle * along(b)});
    p = q;
  }
}

class PathReader {
 public:
  PathReader(std::string_view data, std::size_t most) : in_(data), most_(most) {}

  bool read() {
    char command = 0;
    while (!in_.empty()) {
      if (const char c = in_.letter()) {
        command = c;
        if (command == 'Z' || command == 'z') {
          close();
          continue;
        }
      } else if (command == 0 || command == 'Z' || command == 'z') {
        return false;
      }
      if (count_ > most_ || !segment(command)) return false;
      if (command == 'M') command = 'L';
      if (command == 'm') command = 'l';
    }
    return true;
  }

  std::vector<SvgRun> take() {
    finish();
    return std::move(runs_);
  }

 private:
  bool point(bool relative, Point2& p) {
    if (!in_.number(p.x()) || !in_.number(p.y())) return false;
    if (relative) p += at_;
    return true;
  }

  void add(const Point2& end, Curve::Shape shape = geometry::Line{}) {
    ++count_;
    if (run_.curves.empty() && runs_open_ == false) run_start_ = at_, runs_open_ = true;
    if (!std::holds_alternative<geometry::Line>(shape) || (end - at_).norm() > 0)
      run_.curves.emplace_back(at_, end, std::move(shape));
    at_ = end;
  }

  void close() {
    if (run_.curves.empty()) return;
    if ((run_start_ - at_).norm() > 1e-9 * (1 + at_.norm())) add(run_start_);
    run_.closed = true;
    finish();
    at_ = run_start_;
  }

  void finish() {
    if (!run_.curves.empty()) runs_.push_back(std::move(run_));
    run_ = {};
    runs_open_ = false;
  }

  bool segment(char command) {
    const bool relative = command >= 'a';
    const char kind = relative ? static_cast<char>(command - 'a' + 'A') : command;
    Point2 p, c1, c2;
    const Point2 before = at_;
    switch (kind) {
      case 'M':
        if (!point(relative, p)) return false;
        finish();
        at_ = run_start_ = p;
        break;
      case 'L':
        if (!point(relative, p)) return false;
        add(p);
        break;
      case 'H':
      case 'V': {
        double x;
        if (!in_.number(x)) return false;
        p = at_;
        const int axis = kind == 'H' ? 0 : 1;
        p[axis] = relative ? at_[axis] + x : x;
        add(p);
        break;
      }
      case 'C':
        if (!point(relative, c1) || !point(relative, c2) || !point(relative, p)) return false;
        add(p, geometry::Cubic{c1, c2});
        break;
      case 'S':
        if (!point(relative, c2) || !point(relative, p)) return false;
        c1 = last_ == 'C' || last_ == 'S' ? Point2(2 * before - handle_) : before;
        add(p, geometry::Cubic{c1, c2});
        break;
      case 'Q':
        if (!point(relative, c2) || !point(relative, p)) return false;
        add(p, geometry::Quadratic{c2});
        break;
      case 'T':
        if (!point(relative, p)) return false;
        c2 = last_ == 'Q' || last_ == 'T' ? Point2(2 * before - handle_) : before;
        add(p, geometry::Quadratic{c2});
        break;
      case 'A':
        if (!arc(relative)) return false;
        break;
      default:
        return false;
    }
    handle_ = c2;
    last_ = kind;
    return true;
  }

  /// Appendix F.6 of SVG 1.1.
  bool arc(bool relative) {
    double rx, ry, turn;
    bool large, sweep;
    Point2 p;
    if (!in_.number(rx) || !in_.number(ry) || !in_.number(turn) || !in_.flag(large) || !in_.flag(sweep) ||
        !point(relative, p))
      return false;
    rx = std::fabs(rx), ry = std::fabs(ry);
    if (rx < 1e-9 || ry < 1e-9 || (p - at_).norm() < 1e-12) {
      if ((p - at_).norm() > 0) add(p);
      return true;
    }
    if (rx == ry) {
      const double half = (p - at_).norm() / 2, r = std::max(rx, half),
                   rise = std::sqrt((r - half) * (r + half));
      const double sagitta = large ? r + rise : half * half / (r + rise);
      // A positive sweep turns from x to y, as counter-clockwise does with y up: it bulges to the right of
      // the way.
      add(p, geometry::Arc{sweep ? -sagitta : sagitta});
      return true;
    }
    const double a = turn * (kPi / 180), c = portable::cos(a), s = portable::sin(a);
    Eigen::Matrix2d R;
    R << c, -s, s, c;
    Point2 q = R.transpose() * ((at_ - p) / 2);
    const double over = std::pow(q.x() / rx, 2) + std::pow(q.y() / ry, 2);
    if (over > 1) rx *= std::sqrt(over), ry *= std::sqrt(over);
    const double d = std::pow(rx * q.y(), 2) + std::pow(ry * q.x(), 2);
    const double f = (large == sweep ? -1 : 1) * std::sqrt(std::max(0.0, (rx * rx * ry * ry - d) / d));
    const Point2 centre_local(f * rx * q.y() / ry, -f * ry * q.x() / rx);
    const Point2 centre = R * centre_local + (at_ + p) / 2;
    const Point2 u((q.x() - centre_local.x()) / rx, (q.y() - centre_local.y()) / ry),
        v((-q.x() - centre_local.x()) / rx, (-q.y() - centre_local.y()) / ry);
    double way = angle_between(u, v);
    if (sweep && way < 0) way += 2 * kPi;
    if (!sweep && way > 0) way -= 2 * kPi;
    Eigen::Matrix2d axes = R;
    axes.col(0) *= rx;
    axes.col(1) *= ry;
    std::vector<Curve> pieces;
    add_elliptical(pieces, centre, axes, portable::atan2(u.y(), u.x()), way, p);
    for (Curve& piece : pieces) {
      const auto& cubic = std::get<geometry::Cubic>(piece.shape());
      add(piece.end(), geometry::Cubic{cubic.control_1, cubic.control_2});
    }
    return true;
  }

  Scanner in_;
  std::size_t most_, count_ = 0;
  std::vector<SvgRun> runs_;
  SvgRun run_;
  bool runs_open_ = false;
  Point2 at_{0, 0}, run_start_{0, 0}, handle_{0, 0};
  char last_ = 0;
};

}  // namespace

std::optional<SvgMotion> svg_transform(std::string_view text) {
  SvgMotion all;
  Scanner in(text);
  for (int steps = 0; !in.empty(); ++steps) {
    const std::string_view name = in.word();
    if (name.empty() || steps > 100 || !in.take('(')) return std::nullopt;
    double v[6];
    int n = 0;
    while (n < 6 && in.number(v[n])) ++n;
    if (!in.take(')')) return std::nullopt;
    SvgMotion one;
    if (name == "matrix" && n == 6) {
      one.linear << v[0], v[2], v[1], v[3];
      one.shift = {v[4], v[5]};
    } else if (name == "translate" && (n == 1 || n == 2)) {
      one.shift = {v[0], n == 2 ? v[1] : 0};
    } else if (name == "scale" && (n == 1 || n == 2)) {
      one.linear << v[0], 0, 0, n == 2 ? v[1] : v[0];
    } else if (name == "rotate" && (n == 1 || n == 3)) {
      const double a = v[0] * (kPi / 180), c = portable::cos(a), s = portable::sin(a);
      one.linear << c, -s, s, c;
      if (n == 3) one.shift = Point2(v[1], v[2]) - one.linear * Point2(v[1], v[2]);
    } else if ((name == "skewX" || name == "skewY") && n == 1) {
      const double a = v[0] * (kPi / 180), t = portable::sin(a) / portable::cos(a);
      one.linear << 1, name == "skewX" ? t : 0, name == "skewX" ? 0 : t, 1;
    } else {
      return std::nullopt;
    }
    all = all * one;
    if (!all.linear.allFinite() || !all.shift.allFinite()) return std::nullopt;
  }
  return all;
}

std::vector<SvgRun> svg_path(std::string_view data, std::size_t most, bool& good) {
  PathReader reader(data, most);
  good = reader.read();
  return reader.take();
}

SvgRun moved(const SvgRun& run, const SvgMotion& motion) {
  SvgRun out{{}, run.closed};
  const Eigen::Matrix2d gram = motion.linear.transpose() * motion.linear;
  const double factor = std::sqrt(std::fabs(motion.linear.determinant())),
               sense = motion.linear.determinant() < 0 ? -1 : 1;
  const bool round =
      std::fabs(gram(0, 1)) < 1e-9 * gram.trace() && std::fabs(gram(0, 0) - gram(1, 1)) < 1e-9 * gram.trace();
  for (const Curve& curve : run.curves) {
    const Point2 a = motion(curve.start()), b = motion(curve.end());
    if (const auto* q = std::get_if<geometry::Quadratic>(&curve.shape())) {
      out.curves.emplace_back(a, b, geometry::Quadratic{motion(q->control)});
    } else if (const auto* c = std::get_if<geometry::Cubic>(&curve.shape())) {
      out.curves.emplace_back(a, b, geometry::Cubic{motion(c->control_1), motion(c->control_2)});
    } else if (const auto* arc = std::get_if<geometry::Arc>(&curve.shape())) {
      if (round) {
        out.curves.emplace_back(a, b, geometry::Arc{sense * factor * arc->bulge});
        continue;
      }
      const double half = (curve.end() - curve.start()).norm() / 2, h = std::fabs(arc->bulge),
                   r = (half * half / h + h) / 2;
      const Point2 d = (curve.end() - curve.start()) / (2 * half), left(-d.y(), d.x());
      const double side = arc->bulge > 0 ? 1 : -1;
      const Point2 centre = (curve.start() + curve.end()) / 2 + side * (h - r) * left,
                   u = curve.start() - centre, v = curve.end() - centre;
      double way = angle_between(u, v);
      if (side < 0 && way < 0) way += 2 * kPi;  // to the right of the way is counter-clockwise
      if (side > 0 && way > 0) way -= 2 * kPi;
      std::vector<Curve> pieces;
      add_elliptical(pieces, motion(centre), motion.linear * r, portable::atan2(u.y(), u.x()), way, b);
      Point2 from = a;
      for (const Curve& piece : pieces) {
        out.curves.emplace_back(from, piece.end(), piece.shape());
        from = piece.end();
      }
    } else {
      out.curves.emplace_back(a, b);
    }
  }
  return out;
}

SvgRun svg_ellipse(const Point2& centre, double rx, double ry) {
  const Point2 at[] = {{rx, 0}, {0, ry}, {-rx, 0}, {0, -ry}};
  constexpr double kHandle = 0.5522847498307936;  // 4/3 (sqrt(2) - 1)
  SvgRun run{{}, true};
  for (int k = 0; k < 4; ++k) {
    const Point2 &u = at[k], &v = at[(k + 1) % 4];
    Curve::Shape shape = geometry::Cubic{centre + u + kHandle * v, centre + v + kHandle * u};
    if (rx == ry) shape = geometry::Arc{-rx * (1 - std::sqrt(0.5))};
    run.curves.emplace_back(centre + u, centre + v, std::move(shape));
  }
  return run;
}

std::vector<double> svg_numbers(std::string_view text, std::size_t most) {
  Scanner in(text);
  std::vector<double> out;
  double x;
  while (out.size() < most && in.number(x)) out.push_back(x);
  return out;
}

}  // namespace garment::io
