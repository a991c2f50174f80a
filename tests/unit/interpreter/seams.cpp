// Seams, placements, attachments, pins, bodies.
#include <cmath>

#include "tests/unit/interpreter/support.hpp"

using namespace garment;
using namespace garment::interpreter;
using namespace garment::interpreter::test;

namespace {

/// A rectangle with edges bottom, right_side, top, left_side, counter-clockwise from the lower left.
std::string box(const std::string& name, const std::string& wide, const std::string& high,
                const std::string& rest = "") {
  return "panel " + name + " of fabrics.poplin {\n  outline from (0, 0) {\n    edge bottom to (" + wide +
         ", 0) free\n    edge right_side to (" + wide + ", " + high + ") free\n    edge top to (0, " + high +
         ") free\n    close left_side free\n  }\n" + rest + "}\n";
}
const std::string kUse = "use fabrics, bodies\n";
const std::string kTwo = kUse + box("a", "20 cm", "30 cm") + box("b", "20 cm", "30 cm");
const std::string kForm = "body form = bodies.woman(size: 40)\n";

const design::Seam& seam_of(const Trial& trial, std::size_t k = 0) {
  INFO(trial.text());
  REQUIRE(trial.result.ok());
  REQUIRE(trial.result.garment.seams.size() > k);
  return trial.result.garment.seams[k];
}

design::Point2 start_of(const Trial& trial, const design::SeamSide& side) {
  const design::EdgePart& part = side.parts.front();
  return trial.result.garment.panels[static_cast<std::size_t>(part.panel)]
      .edges[static_cast<std::size_t>(part.edge)]
      .curve.point_at(part.from);
}

int warnings(const Trial& trial, const std::string& code) {
  int n = 0;
  for (const auto& d : trial.result.diagnostics)
    n += d.code == code && d.severity == Severity::warning ? 1 : 0;
  return n;
}

}  // namespace

TEST_CASE("sides run oppositely round counter-clockwise loops, unless reversed") {
  const Trial plain(kTwo + "seam j: a.right_side to b.left_side\n");
  const design::Seam& seam = seam_of(plain);
  CHECK((start_of(plain, seam.sides[0]) - design::Point2(0.2, 0)).norm() < 1e-12);
  CHECK((start_of(plain, seam.sides[1]) - design::Point2(0, 0)).norm() < 1e-12);
  CHECK(seam.ratio == std::vector<double>{1, 1});
  const Trial turned(kTwo + "seam j: a.right_side to b.left_side reversed\n");
  CHECK((start_of(turned, seam_of(turned).sides[1]) - design::Point2(0, 0.3)).norm() < 1e-12);
  // A loop drawn clockwise gives the same seam.
  const Trial clockwise(kUse + box("a", "20 cm", "30 cm") +
                        "panel b of fabrics.poplin {\n outline from (0, 0) {\n edge left_side to (0, 30 cm) "
                        "free\n edge top to (20 cm, 30 "
                        "cm) free\n edge right_side to (20 cm, 0) free\n close bottom free\n }\n}\nseam j: "
                        "a.right_side to b.left_side\n");
  CHECK((start_of(clockwise, seam_of(clockwise).sides[1]) - design::Point2(0, 0)).norm() < 1e-12);
}

TEST_CASE("relations stand at their side") {
  const std::string panels =
      kUse + box("cap", "21.2 cm", "30 cm") + box("hole", "20 cm", "30 cm") + box("frill", "36 cm", "30 cm");
  CHECK(seam_of(Trial(panels + "seam j: cap.top ease 6% to hole.bottom\n")).ratio[0] == Approx(1.06));
  CHECK(seam_of(Trial(panels + "seam j: frill.top gather 1.8 to hole.bottom\n")).ratio[0] == Approx(1.8));
  const Trial at_last(panels + "seam j: hole.bottom to frill.top gather 1.8\n");
  CHECK(seam_of(at_last).ratio[0] == Approx(1 / 1.8));
  CHECK(seam_of(at_last).ratio[1] == 1);
  CHECK(seam_of(Trial(panels + "seam j: hole.bottom stretch 6% to cap.top\n")).ratio[0] == Approx(1 / 1.06));
  const Trial three(panels + box("c", "20 cm", "5 cm") + "seam j: hole.top to c.bottom to cap.top ease 6%\n");
  REQUIRE(seam_of(three).sides.size() == 3);
  CHECK(seam_of(three).ratio[0] == Approx(1 / 1.06));
}

TEST_CASE("the law of lengths") {
  const std::string panels = kUse + box("cap", "52.6 cm", "30 cm") + box("front", "22.4 cm", "30 cm") +
                             box("back", "25.2 cm", "30 cm") +
                             "seam shoulder: front.right_side to back.left_side\n";
  const Trial trial(panels + "seam armhole: «cap.top» ease 4% to back.top + front.top\n");
  INFO(trial.text());
  REQUIRE(trial.result.diagnostics.size() == 1);
  const auto& d = trial.result.diagnostics[0];
  CHECK(d.code == "G0501");
  CHECK(d.message == "seam `armhole` is 31 mm too long on the `cap.top` side");
  CHECK(d.labels[0].span == trial.mark);
  CHECK(d.labels[0].text == "526 mm");
  CHECK(d.labels[1].text == "252 mm + 224 mm, with ease 4% 495 mm");
  CHECK(d.help == "`ease 10.5%` would fit");
  refuses(kUse + box("a", "20 cm", "30 cm") + box("b", "20.4 cm", "30 cm") + "seam j: «a.top» to b.bottom\n",
          "G0501", "`b.bottom ease 2%`");
  accepts(Trial(kUse + box("a", "20 cm", "30 cm") + box("b", "20.15 cm", "30 cm") +
                "seam j: a.top to b.bottom\n"));
  refuses(kUse + box("a", "40 cm", "30 cm") + box("b", "20 cm", "30 cm") + "seam j: «a.top» to b.bottom\n",
          "G0501", "`a.top gather 2`");
  // Darts are closed before lengths are compared.
  accepts(Trial(kUse + box("a", "20 cm", "30 cm", "  dart d on top at 50% width 3 cm depth 8 cm\n") +
                box("b", "17 cm", "30 cm") + "seam j: a.top to b.bottom\n"));
}

TEST_CASE("chains meet where other seams join them") {
  const std::string panels =
      kUse + box("sleeve", "40 cm", "30 cm") + box("front", "20 cm", "30 cm") + box("back", "20 cm", "30 cm");
  // Counter-clockwise a top runs from right to left: front.top ends where front.left_side is.
  const std::string shoulder = "seam shoulder: front.left_side to back.right_side\n";
  const Trial good(panels + shoulder + "seam j: sleeve.bottom to front.top + back.top\n");
  REQUIRE(seam_of(good, 1).sides[1].parts.size() == 2);
  // The second side is walked against the rule: back first.
  CHECK(seam_of(good, 1).sides[1].parts[0].panel == 2);
  CHECK_FALSE(seam_of(good, 1).sides[1].closed);
  refuses(panels + shoulder + "seam j: sleeve.bottom to «back.top + front.top»\n", "G0503");
  refuses(panels + shoulder + "seam j: sleeve.bottom to «front.top - back.top»\n", "G0503",
          "put `-` before it");
  refuses(panels + "seam j: sleeve.bottom to «front.top + back.top»\n", "G0503", "missing");
  // A tube sewn to a tube: rings.
  const Trial ring(kUse + box("a", "20 cm", "30 cm") + box("b", "20 cm", "10 cm") +
                   "seam one: a.left_side to a.right_side\nseam two: b.left_side to b.right_side\nseam j: "
                   "a.bottom to b.top\n");
  CHECK(seam_of(ring, 2).sides[0].closed);
  CHECK(seam_of(ring, 2).sides[1].closed);
}

TEST_CASE("parts of edges") {
  const Trial trial(
      kUse + box("a", "20 cm", "30 cm", "  notch n on right_side at 12 cm\n") + box("b", "20 cm", "30 cm") +
      "seam one: a.right_side[start .. n] to b.left_side[18 cm .. end]\nseam two: a.top[1/4 .. 3/4] to "
      "b.bottom[5 cm .. 15 cm]\n"
      "measure part = length(a.right_side[n .. end])\nmeasure mark = distance(a.right_side.n, (20 cm, 0))\n"
      "measure at = a.top.at(5 cm).x\n");
  const design::Seam& seam = seam_of(trial);
  CHECK(seam.sides[0].parts[0].to == Approx(0.12));
  CHECK(seam.sides[1].parts[0].to == Approx(0.18));  // left_side is drawn downwards
  CHECK(*trial.result.measures[0].value == Approx(0.18));
  CHECK(*trial.result.measures[1].value == Approx(0.12));
  CHECK(*trial.result.measures[2].value == Approx(0.15));
  refuses(kTwo + "seam j: a.top[start .. «40 cm»] to b.top\n", "G0309", "20 cm");
  refuses(kTwo + "seam j: «a.top[50% .. 20%]» to b.top\n", "G0309", "no length");
  refuses(kTwo + "seam j: a.top[start .. «hipp»] to b.top\n", "G0301");
}

TEST_CASE("both, and halves") {
  const std::string half =
      "panel f of fabrics.poplin on fold cf {\n outline from (0, 0) {\n edge hem to (20 cm, 0) free\n edge "
      "side to (20 cm, 30 cm)\n edge "
      "waist to (0, 30 cm) free\n close cf\n }\n}\npanel q of fabrics.poplin like f { }\n";
  const Trial trial(kUse + half + "both seam side: f.side to q.side\nmeasure a = length(f.left.side)\n");
  REQUIRE(trial.result.garment.seams.size() == 2);
  CHECK(trial.result.garment.seams[0].name == "side.left");
  CHECK(trial.result.garment.seams[1].name == "side.right");
  CHECK(trial.result.diagnostics.empty());
  refuses(kUse + half + "seam side: «f.side» to q.left.side\nseam other: f.right.side to q.right.side\n",
          "G0311", "`f.left.side` or `f.right.side`");
  refuses(kTwo + "both «seam j: a.right_side to b.left_side»\n", "G0330");
  refuses(kUse + half + "seam side: f.left.«sied» to q.left.side\n", "G0311", "did you mean `side`?");
}

TEST_CASE("a chain of right halves is the image of that of the left ones") {
  // Front and back of a body with an armhole each, sleeves as a pair of tubes.
  const std::string body =
      std::string("panel front of fabrics.poplin on fold cf {\n outline from (0, 0) {\n edge hem to (20 cm, 0) free\n edge side to "
      "(20 cm, 30 cm)\n edge armhole to (15 cm, 50 cm)\n edge shoulder to (0, 50 cm)\n close cf\n }\n}\n"
      "panel back of fabrics.poplin like front { }\n") +
      kForm + "place back on form.back with shoulder at form.shoulder\n";
  const std::string sleeves =
      "let wide = 2 * length(front.left.armhole)\n"
      "pair panel sleeve of fabrics.poplin {\n outline from (0, 0) {\n edge cuff to (wide, 0) free\n edge under_a to "
      "(wide, 20 cm)\n edge cap to (0, 20 cm)\n close under_b\n }\n}\n"
      "both seam side: front.side to back.side\nboth seam shoulder: front.shoulder to back.shoulder\n"
      "both seam under: sleeve.under_a to sleeve.under_b\n";
  const std::string head = kUse + body + sleeves;
  auto starts_at_side = [](const Trial& trial, std::size_t k) {
    return std::fabs(start_of(trial, seam_of(trial, k).sides[1]).y() - 0.3) < 1e-12;
  };
  // Counter-clockwise the left armhole begins under the arm; so must the right one, which is walked back first.
  const Trial plain(head + "both seam cap: sleeve.cap to front.armhole + back.armhole\n");
  CHECK(seam_of(plain, 6).name == "cap.left");
  CHECK(seam_of(plain, 6).sides[1].parts.front().panel == 1);  // the second side runs against the rule
  CHECK(seam_of(plain, 7).sides[1].parts.front().panel == 0);
  CHECK(starts_at_side(plain, 6));
  CHECK(starts_at_side(plain, 7));
  // Written from the shoulder, both begin there, unless the script says where.
  const std::string turned = head + "both seam cap: sleeve.cap to back.armhole + front.armhole";
  const Trial shoulder(turned + "\n");
  CHECK_FALSE(starts_at_side(shoulder, 6));
  CHECK_FALSE(starts_at_side(shoulder, 7));
  const Trial stated(turned + " start at under, side\n");
  CHECK(starts_at_side(stated, 6));
  CHECK(starts_at_side(stated, 7));
  // Open chains, `-`, and ranges.
  const std::string strip =
      "pair panel strip of fabrics.poplin {\n outline from (0, 0) {\n edge low to (20 cm, 0) free\n edge edge_a to (20 cm, "
      "LONG)\n edge high to (0, LONG) free\n close edge_b free\n }\n}\nlet LONG = 30 cm + length(front.left.armhole)\n";
  const Trial open(kUse + body + strip + "both seam shoulder: front.shoulder to back.shoulder\n" +
                   "both seam j: strip.edge_a to front.side + front.armhole\n");
  CHECK(seam_of(open, 2).sides[1].parts.size() == 2);
  CHECK(seam_of(open, 3).sides[1].parts.size() == 2);
  const Trial eased(head + "both seam cap: sleeve.cap to front.armhole ease 0% [start .. 5 cm] + back.armhole\n");
  CHECK_FALSE(eased.result.ok());  // a relation follows its whole side
  const Trial full(head +
                   "both seam cap: sleeve.cap to front.armhole + back.armhole gather 1.001 [start .. 5 cm]\n");
  for (std::size_t k : {6U, 7U}) {
    const design::SeamSide& side = seam_of(full, k).sides[1];
    const std::size_t at = k == 6 ? side.parts.size() - 1 : 0;  // on the front, under the arm
    CHECK(side.parts[at].panel == 0);
    CHECK(std::fabs(side.parts[at].to - side.parts[at].from) == Approx(0.05));
    CHECK(side.fullness[at] == Approx(1.001));
  }
}

TEST_CASE("what a seam may not be") {
  refuses(kTwo + "«seam» j: a.top\n", "G0507");
  refuses(kTwo + "seam j: «a» to b.top\n", "G0306", "its edges are");
  refuses(kTwo + "seam j: a.«tpo» to b.top\n", "G0311", "did you mean `top`?");
  refuses(kTwo + "seam j: a.top ease «60%» to b.top\n", "G0309", "0% .. 50%");
  refuses(kTwo + "seam j: a.top ease 2% «gather 2» to b.top\n", "G0314");
  refuses(kTwo + "seam j: a.top ease 6% «(1 cm, 2 cm)» to b.top\n", "G0313", "[notch_f .. notch_b]");
  refuses(kTwo + "seam j: a.top to «a.top»\n", "G0509", "200 mm of `a.top` to itself");
  refuses(kTwo + "seam i: a.right_side to b.left_side\nseam j: b.right_side to «a.left_side» reversed\n", "G0510",
          "leave out `reversed`");
  refuses(kTwo + "panel disc of fabrics.poplin {\n outline circle((0, 0), 9 cm)\n}\npanel cap of fabrics.poplin like "
                 "disc { }\nseam j: «disc.rim» to cap.rim\n",
          "G0511", "start at PANEL.NOTCH");
  refuses(kTwo + "seam j: a.top to b.top start at «a.bottom.middle»\n", "G0512");
  refuses(kTwo + "seam j: a.top to b.top lapped 1 cm «turned»\n", "G0513");
  refuses(kTwo + "seam j: a.top to b.top ironed toward «a.bottom»\n", "G0514", "own sides");
  refuses(kTwo + "seam j: a.top ease 2% [start .. 10 cm] ease 4% «[5 cm .. end]» to b.top\n", "G0516");
  refuses(kTwo + "seam j: a.top ease «2 cm» to b.top\n", "G0305");
  refuses(kTwo + "seam j: a.top to b.top\nseam «j»: a.bottom to b.bottom\n", "G0302");
}

TEST_CASE("what stays unsewn is said once, with its name") {
  const std::string open = kUse +
                           "panel p of fabrics.poplin on fold cf {\n outline from (0, 0) {\n edge hem to (20 "
                           "cm, 0)\n edge side to (20 cm, 30 "
                           "cm)\n edge waist to (0, 30 cm)\n close cf\n }\n}\n";
  const Trial trial(open);
  CHECK(trial.result.ok());
  REQUIRE(warnings(trial, "G0505") == 1);
  const auto& told = *std::find_if(trial.result.diagnostics.begin(), trial.result.diagnostics.end(),
                                   [](const auto& d) { return d.code == "G0505"; });
  CHECK(told.message == "edges of panel `p` are neither sewn nor attached: `hem`, `side` and `waist`");
  CHECK(told.labels.size() == 3);
  const Trial attached(open + kForm + "attach p.waist to form.waist\n");
  CHECK(warnings(attached, "G0505") == 1);
  const Trial sewn(open +
                   "panel q of fabrics.poplin like p { }\nseam l: p.left.side[start .. 50%] to "
                   "q.left.side[start .. 50%]\n");
  CHECK(warnings(sewn, "G0505") == 2);
  bool partly = false;
  for (const auto& d : sewn.result.diagnostics)
    partly = partly || d.message.find("15 cm of `left.side`") != std::string::npos;
  CHECK(partly);
  const Trial half(
      kTwo +
      "seam j: a.top[0 .. 50%] to b.bottom[0 .. 50%]\nseam k: a.top[30% .. 80%] to b.bottom[30% .. 80%]\n");
  CHECK(warnings(half, "G0508") == 2);
}

TEST_CASE("placements") {
  const std::string head = kTwo + kForm;
  const Trial trial(head +
                    "place a on form.front with top at form.waist offset 2 cm\nplace b at (1 cm, 2 cm, 3 cm) "
                    "turn (0, 90 deg, 0)\n");
  INFO(trial.text());
  REQUIRE(trial.result.ok());
  const design::Placement &on = trial.result.garment.panels[0].placement,
                          &at = trial.result.garment.panels[1].placement;
  CHECK(on.kind == design::Placement::Kind::on_part);
  CHECK(on.body == "form");
  CHECK(on.part == "front");
  CHECK(on.edge == "top");
  CHECK(on.level == "waist");
  CHECK(on.offset == Approx(0.02));
  CHECK(at.kind == design::Placement::Kind::rigid);
  CHECK((at.rotation * Eigen::Vector3d(1, 0, 0) - Eigen::Vector3d(0, 0, -1)).norm() < 1e-15);
  CHECK((at.translation - Eigen::Vector3d(0.01, 0.02, 0.03)).norm() < 1e-15);
  // R = Rz Ry Rx: x is turned first.
  const Trial order(head + "place a at (0, 0, 0) turn (90 deg, 90 deg, 0)\n");
  CHECK((order.result.garment.panels[0].placement.rotation * Eigen::Vector3d(0, 1, 0) -
         Eigen::Vector3d(1, 0, 0))
            .norm() < 1e-15);
  CHECK(Trial(head + "place a around form.arm.left\n").result.garment.panels[0].placement.part == "arm.left");
  const Trial shape(kUse + "body can = cylinder(radius: 10 cm, height: 50 cm)\n" + box("a", "20 cm", "30 cm") + "place a around can\n");
  CHECK(shape.result.ok());
  CHECK(shape.result.garment.panels[0].placement.body == "can");
  CHECK(shape.result.garment.panels[0].placement.part.empty());
  refuses(head + "place a around «form»\n", "G0306", "a plain shape");
  const Trial inside(kUse + kForm +
                     box("a", "20 cm", "30 cm", "  place on form.back with top at form.waist\n"));
  CHECK(inside.result.ok());
  CHECK(inside.result.garment.panels[0].placement.part == "back");

  refuses(head + "place a on «form.frnot»\n", "G0611", "did you mean `front`?");
  refuses(head + "place a around «form.arm.lft»\n", "G0611", "arm.left");
  refuses(head + "place a on form.front with top at «form.wiast»\n", "G0611", "did you mean `waist`?");
  refuses(head + "place a on form.front with «tpo» at form.waist\n", "G0301", "did you mean `top`?");
  refuses(head + "place a on form.front «with top»\n", "G0312", "LEVEL");
  refuses(head + "place a on form.front offset «2 m»\n", "G0309", "50 cm");
  refuses(head + "place a on form.front with «b.top» at form.waist\n", "G0610");
  refuses(head + "body other = bodies.man(size: 50)\nplace a on form.front with top at «other.waist»\n",
          "G0610");
  refuses(head + "place a on form.front\n«place a on form.back»\n", "G0612");
  refuses(head + "«place» a\n", "G0312");
  refuses(head + "place «form» on form.front\n", "G0306");
  refuses(head + "place a at «(0, 0)»\n", "G0306");
  refuses(head + "place a at (0, 0, 0) «offset» 1 cm\n", "G0313");
  refuses(head + "place a flat at (0, 0, 0) «turn (0, 1 rad, 0)»\n", "G0415");
  refuses(head + "place a at (0, 0, 0) turn «(0, 90, 0)»\n", "G0308");
}

TEST_CASE("attachments, pins, gravity") {
  const std::string head = kTwo + kForm;
  const Trial trial(head +
                    "attach a.top, b.top to form.waist hold\npin p on a at (3 cm, 4 cm)\npin q on a at "
                    "a.top.start\ngravity 1.62 m/s^2\n");
  INFO(trial.text());
  REQUIRE(trial.result.ok());
  const design::Garment& g = trial.result.garment;
  REQUIRE(g.attachments.size() == 1);
  CHECK(g.attachments[0].parts.size() == 2);
  CHECK_FALSE(g.attachments[0].slide);
  CHECK(g.pins[1].point == design::Point2(0.2, 0.3));
  CHECK(g.gravity == Eigen::Vector3d(0, -1.62, 0));
  CHECK(Trial(head + "attach a.top to form.waist\n").result.garment.attachments[0].slide);
  CHECK(Trial("gravity (0, -3 m/s^2, 1 m/s^2)\n").result.garment.gravity == Eigen::Vector3d(0, -3, 1));
  refuses(head + "attach a.top to «form.wasit»\n", "G0611");
  refuses(head + "attach «a» to form.waist\n", "G0306");
  refuses(head + "«attach a.top to form.waist slide hold»\n", "G0415");
  refuses(head + "pin p on a at «(30 cm, 4 cm)»\n", "G0613");
  refuses(head + "pin p on a at «b.top.start»\n", "G0613");
  refuses(head + "pin p on a at «(3, 4)»\n", "G0308");
  refuses("gravity «9.81»\n", "G0308", "m/s^2");
  refuses("gravity 9.81 «km/s^2»\n", "G0313");
}

TEST_CASE("bodies") {
  const Trial trial(
      kUse + kForm +
      "measure w = form.waist.girth\nmeasure h = form.hip.height\n"
      "body ball = sphere(radius: 15 cm) at (0, 1 m, 0) friction 0.5\nbody ground = floor\nbody b = "
      "box(size: (1 m, 72 cm, 80 cm))\n"
      "body e = ellipsoid(semi_axes: (20 cm, 30 cm, 15 cm))\nbody mine = mesh(\"a.obj\", scale: 0.01)\n");
  INFO(trial.text());
  REQUIRE(trial.result.ok());
  CHECK(*trial.result.measures[0].value == Approx(0.76));
  const design::Garment& g = trial.result.garment;
  REQUIRE(g.bodies.size() == 6);
  REQUIRE(trial.result.bodies.size() == 6);
  const auto& person = std::get<design::Mannequin>(g.bodies[0].shape);
  CHECK(person.size == 40);
  CHECK(person.measures.at("bust_chest") == Approx(0.92));
  CHECK(person.measures.at("stature") == Approx(1.68));
  CHECK(person.measures.size() == 37);
  CHECK(g.bodies[1].position == Eigen::Vector3d(0, 1, 0));
  CHECK(g.bodies[1].friction == 0.5);
  CHECK(std::get<design::MeshFile>(g.bodies[5].shape).scale == 0.01);

  auto measure = [](const std::string& call, const std::string& name) {
    const Trial t("use bodies\nbody form = " + call + "\n");
    INFO(t.text());
    REQUIRE(t.result.ok());
    return std::get<design::Mannequin>(t.result.garment.bodies[0].shape).measures.at(name);
  };
  CHECK(measure("bodies.woman(size: 39)", "waist") == Approx(0.74));
  CHECK(measure("bodies.woman(size: 48)", "hip") == Approx(1.17));
  CHECK(measure("bodies.woman(bust: 94 cm)", "bust_chest") == Approx(0.94));
  CHECK(measure("bodies.woman(bust: 94 cm)", "underbust") == Approx(0.79));
  CHECK(measure("bodies.woman(stature: 184.8 cm)", "kneeheightmidpatella") == Approx(0.467 * 1.1));
  CHECK(measure("bodies.man(size: 50)", "waist") == Approx(0.88));
  CHECK(measure("bodies.man(size: 45)", "stature") == Approx(1.695));

  refuses("use bodies\nbody form = bodies.woman(«sise»: 40)\n", "G0307", "did you mean `size`?");
  refuses("use bodies\nbody form = «bodies.woman(size: 60)»\n", "G0309", "34 .. 48");
  refuses("use bodies\nbody form = bodies.woman(bust: «94»)\n", "G0308", "94 cm");
  refuses("body form = mannequin(sex: \"woman\", size: 40, bust_chest: «94»)\n", "G0308");
  refuses("body form = mannequin(sex: «\"dog\"», size: 40)\n", "G0309");
  refuses("body form = «3 cm»\n", "G0306");
  refuses("body form = sphere(radius: «15»)\n", "G0308");
  refuses("body form = sphere(radius: 15 «km»)\n", "G0105");
  refuses("body form = sphere(15 cm) friction «9»\n", "G0309");
  refuses("body form = mesh(«\"../../a.obj\"»)\n", "G0328");
  refuses(kUse + kForm + "let a = «form.wiast».girth\n", "G0611", "did you mean `waist`?");
  refuses("body ball = sphere(15 cm)\nlet a = «ball.waist».girth\n", "G0611", "plain shape");
}

TEST_CASE("the bodies agree with the size table") {
  const std::string path = std::string(GARMENT_DATA_DIR) + "/tables/mannequin_sizes.csv";
  const auto text = system_host().read_file(path, 1 << 20);
  if (!text) {
    WARN("skipped: " << path << " is not there");
    return;
  }
  std::vector<std::vector<std::string>> rows;
  std::string line;
  for (char c : *text.value + "\n") {
    if (c != '\n') {
      line += c;
      continue;
    }
    if (!line.empty() && line[0] != '#') {
      rows.emplace_back(1);
      for (char d : line) {
        if (d == ',')
          rows.back().emplace_back();
        else
          rows.back().back() += d;
      }
    }
    line.clear();
  }
  REQUIRE(rows.size() == 17);
  for (std::size_t r = 1; r < rows.size(); ++r) {
    const Trial t("use bodies\nbody form = bodies." + std::string(rows[r][0] == "F" ? "woman" : "man") +
                  "(size: " + rows[r][1] + ")\n");
    REQUIRE(t.result.ok());
    const auto& measures = std::get<design::Mannequin>(t.result.garment.bodies[0].shape).measures;
    for (std::size_t k = 2; k < rows[0].size(); ++k) {
      if (rows[r][k].empty() || rows[0][k] == "weightkg") continue;
      INFO(rows[r][0] << rows[r][1] << ' ' << rows[0][k]);
      CHECK(measures.at(rows[0][k]) == Approx(std::stod(rows[r][k]) / 100).epsilon(1e-12));
    }
  }
}
