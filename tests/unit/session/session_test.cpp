// What a session answers, drapes, takes back and saves.
#include "interpreter/session/commands.hpp"
#include "tests/unit/session/support.hpp"

using namespace garment;
using namespace garment::session;
using namespace garment::session::test;

TEST_CASE("expressions are answered with their units, and kept as `it`") {
  Prompt prompt;
  CHECK(prompt.enter("wide * 2") == "20 cm\n");
  CHECK(prompt.enter("it + 1 cm") == "21 cm\n");
  CHECK(prompt.enter("cloth.top") == "cloth.top: 10 cm\n");
  CHECK(has(prompt.enter("it"), "cloth.top"));
  CHECK(has(prompt.enter("length(it)"), "10 cm"));
  CHECK(
      has(prompt.enter("cloth"), "panel cloth: 100 cm^2 of thin; edges bottom, right_side, top, left_side"));
  CHECK(has(prompt.enter("cloth.topp", Outcome::refused), "did you mean `top`?"));
  CHECK(has(prompt.enter("strain(all)", Outcome::refused), "error[G0325]"));
  CHECK_FALSE(prompt.session.unsaved());
}

TEST_CASE("acts run at once and stay out of the script") {
  Prompt prompt;
  CHECK(has(prompt.enter("expect strain(all) < 50%", Outcome::refused), "error[G0325]"));
  CHECK(has(prompt.enter("drape until rest settle preview"), "at rest: "));
  CHECK(has(prompt.enter("expect strain(all) < 50%"), "ok     strain(all) < 50%: found "));
  CHECK(has(prompt.enter("expect strain(all) > 50%", Outcome::unmet), "FAILED strain(all) > 50%"));
  CHECK(has(prompt.enter("save \"a.obj\""), "wrote square/a.obj"));
  CHECK(prompt.host.files.contains("square/a.obj"));
  CHECK(prompt.text() == kSquare);
  CHECK(has(prompt.enter("cloth.bottom"), "in the drape"));
  CHECK(has(prompt.enter("measure low = position(one).y"), "low = 1"));
  CHECK(prompt.text().find("measure low") > prompt.text().find("expect penetrations"));
}

TEST_CASE("an assertion is judged and not kept") {
  Prompt prompt;
  CHECK(prompt.enter("assert wide == 10 cm") == "ok\n");
  CHECK(has(prompt.enter("assert wide > tall", Outcome::refused), "error[G0320]"));
  CHECK_FALSE(prompt.session.unsaved());
}

TEST_CASE("undo and redo give back text, model and shape exactly") {
  Prompt prompt;
  prompt.enter("drape until rest settle preview");
  const std::string draped = prompt.session.state_hash();
  const std::string answer = prompt.enter("wide = 12 cm");
  CHECK(has(answer, "wide: 10 cm -> 12 cm"));
  CHECK(has(answer, "meshed again: cloth"));
  CHECK(has(answer, "at rest: "));
  const std::string edited = prompt.session.state_hash();
  CHECK(edited != draped);
  prompt.enter(":undo");
  CHECK(prompt.session.state_hash() == draped);
  CHECK(prompt.text() == kSquare);
  prompt.enter(":redo");
  CHECK(prompt.session.state_hash() == edited);
  prompt.enter(":undo 2");
  CHECK(has(prompt.enter(":where"), "not draped"));
  prompt.enter("tall = 9 cm");
  CHECK(has(prompt.enter(":redo", Outcome::refused), "error[G1505]"));
}

TEST_CASE("steps far back are built again and hang as they hung") {
  Prompt prompt;
  prompt.enter("drape until rest settle preview");
  std::vector<std::string> hashes{prompt.session.state_hash()};
  for (int k = 0; k < 12; ++k) {
    prompt.enter("wide = " + std::to_string(110 + k) + " mm");
    hashes.push_back(prompt.session.state_hash());
  }
  for (int k = 11; k >= 0; --k) {
    prompt.enter(":undo");
    CHECK(prompt.session.state_hash() == hashes[static_cast<std::size_t>(k)]);
  }
  CHECK(has(prompt.enter("cloth.bottom"), "10 cm, "));
}

TEST_CASE("an edit that means nothing to the model leaves the shape alone") {
  Prompt prompt;
  prompt.enter("drape until rest settle preview");
  const std::string hash = prompt.session.state_hash();
  CHECK(has(prompt.enter("let spare = 3 cm"), "model: as it was"));
  CHECK(prompt.session.state_hash() == hash);
  CHECK(has(prompt.enter(":where"), "at rest after"));
}

TEST_CASE("a panel that is placed elsewhere starts there") {
  Prompt prompt;
  const std::string start = prompt.session.state_hash();
  prompt.enter("place cloth at (0, 2 m, 0)");
  CHECK(prompt.session.state_hash() != start);
  CHECK(prompt.session.stage().shape.state->position[0].y() > 1.5);
}

TEST_CASE("without `auto` the shape is carried over and waits") {
  Prompt prompt;
  prompt.enter("drape until rest settle preview");
  prompt.enter(":set auto off");
  CHECK(has(prompt.enter("wide = 12 cm"), "carried over"));
  CHECK(has(prompt.enter(":where"), "not at rest"));
  CHECK(has(prompt.enter("expect strain(all) < 50%", Outcome::refused), "error[G0325]"));
  CHECK(has(prompt.enter("drape until rest settle preview"), "at rest"));
}

TEST_CASE("a drape that is stopped keeps its shape and goes on") {
  int asked = 0;
  bool stop = true;
  SessionOptions options;
  options.interrupted = [&] { return stop && ++asked > 3; };
  Prompt prompt(kSquare, options);
  const std::string start = prompt.session.state_hash();
  CHECK(has(prompt.enter("drape until rest", Outcome::interrupted), "the shape is kept"));
  CHECK(prompt.session.state_hash() != start);
  stop = false;
  CHECK(has(prompt.enter("drape until rest"), "at rest"));
  prompt.enter(":undo 2");
  CHECK(prompt.session.state_hash() == start);
}

TEST_CASE("a garment is built up statement by statement") {
  Prompt prompt("");
  prompt.enter("use fabrics");
  prompt.enter("fabric thin = fabrics.satin");
  prompt.enter(
      "panel cloth of thin {\n  outline from (0, 0) {\n    edge a to (10 cm, 0) free\n"
      "    edge b to (10 cm, 10 cm) free\n    edge c to (0, 10 cm) free\n    close d free\n  }\n}");
  prompt.enter("place cloth at (0, 1 m, 0)");
  prompt.enter("pin one on cloth at cloth.c.start");
  CHECK(has(prompt.enter("pin two on cloth at cloth.c.end"), "particles"));
  CHECK(has(prompt.enter(":list panel"), "panel  cloth"));
}

TEST_CASE("saving writes the edits and nothing else") {
  Prompt prompt;
  prompt.enter("wide = 12 cm");
  CHECK(prompt.session.unsaved());
  CHECK(has(prompt.enter(":diff"), "+param wide = 12 cm in"));
  CHECK(has(prompt.enter(":save"), "wrote square.garment"));
  CHECK_FALSE(prompt.session.unsaved());
  CHECK(prompt.host.files["square.garment"] == prompt.text());
  CHECK(prompt.enter(":diff") == "no difference\n");
}

TEST_CASE("a file that someone else changed is not written over unasked") {
  Prompt prompt;
  prompt.enter("wide = 12 cm");
  prompt.host.files["square.garment"] += "# theirs\n";
  CHECK(has(prompt.enter(":save", Outcome::refused), "error[G1507]"));
  CHECK(has(prompt.host.files["square.garment"], "# theirs"));
  CHECK(has(prompt.enter(":reload", Outcome::refused), "error[G1508]"));
  CHECK(has(prompt.enter(":save!"), "wrote"));
  prompt.host.files["other.garment"] = "let a = 1\n";
  CHECK(has(prompt.enter(":save other.garment", Outcome::refused), "error[G1507]"));
  prompt.enter(":load other.garment");
  CHECK(prompt.text() == "let a = 1\n");
  CHECK(has(prompt.enter(":load nowhere.garment", Outcome::refused), "error[G0901]"));
  CHECK(prompt.text() == "let a = 1\n");
}

TEST_CASE("commands say what is wrong with them") {
  Prompt prompt;
  CHECK(has(prompt.enter(":undoo", Outcome::refused), "did you mean `:undo`?"));
  CHECK(has(prompt.enter(":nonsense", Outcome::refused), "error[G1501]"));
  CHECK(has(prompt.enter(":model big", Outcome::refused), "error[G1502]"));
  CHECK(has(prompt.enter(":set auto perhaps", Outcome::refused), "takes on or off"));
  CHECK(has(prompt.enter(":set colour red", Outcome::refused), "there is no setting `colour`"));
  CHECK(has(prompt.enter(":undo many", Outcome::refused), "error[G1502]"));
  CHECK(has(prompt.enter(":help pannel", Outcome::refused), "did you mean `panel`?"));
  Prompt empty("");
  CHECK(has(empty.enter("drape until rest", Outcome::refused), "error[G1504]"));
  MemoryHost host;
  Session fresh(host, Prompt::with_library({}));
  CHECK(has(fresh.enter(":save").text, "error[G1506]"));
}

TEST_CASE("help, info and lists speak of the language and the script") {
  Prompt prompt;
  CHECK(has(prompt.enter(":help seam"), "seam NAME"));
  CHECK(has(prompt.enter(":help undo"), ":undo [N]"));
  CHECK(has(prompt.enter(":help"), ":quit"));
  const std::string info = prompt.enter(":info wide");
  CHECK(has(info, "10 cm\n"));
  CHECK(has(info, "declared as param at square.garment:4"));
  CHECK(has(info, "allowed 2 cm .. 50 cm"));
  CHECK(has(info, "used by panel cloth"));
  CHECK(has(prompt.enter(":info cloth"), "## The cloth."));
  CHECK(has(prompt.enter(":info cloth.top"), "used by pin one, pin two"));
  CHECK(has(prompt.enter(":list"), "let     tall   10 cm"));
  CHECK(has(prompt.enter(":text tall"), "let tall = 10 cm"));
  CHECK(has(prompt.enter(":model"), "particles"));
  CHECK(prompt.enter(":warnings") == "none\n");
}

TEST_CASE("completion knows commands, the language and the script") {
  Prompt prompt;
  auto texts = [&](const std::string& entry) {
    std::string all;
    for (const Proposal& p : prompt.session.complete(entry)) all += p.text + ' ';
    return all;
  };
  CHECK(texts(":und") == "undo ");
  CHECK(has(texts("cloth."), "top"));
  CHECK(has(texts("wi"), "wide"));
  CHECK(has(texts(":info cl"), "cloth"));
  CHECK(has(texts(":set a"), "auto"));
}

TEST_CASE("completion knows the files that a command takes") {
  SessionOptions options;
  options.folder_entries = [](const std::string& folder) -> std::vector<std::string> {
    if (folder == "old/") return {"coat.garment"};
    if (!folder.empty()) return {};
    return {".hidden/", "old/", "skirt.garment", "skirt.png", "square.garment"};
  };
  Prompt prompt(kSquare, options);
  auto texts = [&](const std::string& entry) {
    std::string all;
    for (const Proposal& p : prompt.session.complete(entry)) all += p.text + ' ';
    return all;
  };
  CHECK(texts(":load ") == "old/ skirt.garment square.garment ");
  CHECK(texts(":load  sk") == "skirt.garment ");
  CHECK(texts(":load \"old/c") == "coat.garment ");
  CHECK(texts(":save! squ") == "square.garment ");
  CHECK(texts(":view s") == "skirt.png ");
  CHECK(texts(":load .h") == ".hidden/ ");
  CHECK(prompt.session.complete(":load old/co")[0].replace == 2);
}

TEST_CASE("a pin that is released stays so until the panels are back at their places") {
  Prompt prompt;
  prompt.enter("drape until rest settle preview");
  const std::string held = prompt.session.state_hash();
  CHECK(has(prompt.enter("release one"), "released one"));
  CHECK(prompt.session.stage().modelled->model->hold_particle.size() == 1);
  CHECK(has(prompt.enter("release one", Outcome::refused), "error[G1320]"));
  prompt.enter("drape until rest settle preview");
  CHECK(prompt.session.state_hash() != held);
  prompt.enter("wide = 11 cm");  // the model is made anew, without the pin
  CHECK(prompt.session.stage().modelled->model->hold_particle.size() == 1);
  CHECK_FALSE(has(prompt.text(), "release"));
  prompt.enter(":undo 3");
  CHECK(prompt.session.state_hash() == held);
  CHECK(prompt.session.stage().modelled->model->hold_particle.size() == 2);
  prompt.enter(":redo 2");
  prompt.enter(":reset");
  CHECK(prompt.session.stage().modelled->model->hold_particle.size() == 2);
}

TEST_CASE("the script's own release happens when it is run, not before") {
  const std::string script = std::string(kSquare) + "release two\ndrape until rest settle preview\n";
  Prompt prompt(script);
  prompt.enter("drape until rest settle preview");
  prompt.enter("release two");
  prompt.enter("drape until rest settle preview");
  const std::string hung = prompt.session.state_hash();
  prompt.enter(":run");
  CHECK(prompt.session.state_hash() == hung);
  prompt.enter("release two", Outcome::refused);
}

TEST_CASE("acts that the prompt cannot do say who can") {
  Prompt prompt;
  CHECK(has(prompt.enter("vary wide over 5 cm, 6 cm { drape until rest }", Outcome::refused), "garment run"));
  CHECK(has(prompt.enter("drape for 50 ms"), "ran for its time: 0.05 s"));
  CHECK(has(prompt.enter("record curve elapsed, energy every 10 ms as \"fall.csv\"", Outcome::refused), "error[G1325]"));
}

TEST_CASE("the script's own acts run from the placed panels, as one step") {
  Prompt prompt;
  const std::string start = prompt.session.state_hash();
  CHECK(has(prompt.enter(":run"), "ok     penetrations == 0"));
  const std::string draped = prompt.session.state_hash();
  prompt.enter(":run");
  CHECK(prompt.session.state_hash() == draped);
  prompt.enter(":undo 2");
  CHECK(prompt.session.state_hash() == start);
}

namespace {

/// Two squares that hang from clamps, the lining before the front that it is declared under.
const char* kLiningOutside = R"(garment 1 "lining outside"
use fabrics
panel front of fabrics.satin {
  outline from (0, 0) {
    edge low to (10 cm, 0) free
    edge right_side to (10 cm, 10 cm) free
    edge high to (0, 10 cm) free
    close left_side free
  }
  resolution 2 cm
}
panel lining of fabrics.satin like front under front {}
clamp one: front.high
clamp two: lining.high
place front at (0, 1 m, 0)
place lining at (0, 1 m, 1 cm)
)";

}  // namespace

TEST_CASE("a start that only a drape minds is told where the script drapes, else by the first drape that is typed") {
  Prompt drapes(std::string(kLiningOutside) + "drape until rest settle preview\n");
  CHECK(has(drapes.last.text, "warning[G0609]"));
  CHECK_FALSE(has(drapes.enter("drape until rest settle preview", Outcome::unmet), "warning[G0609]"));

  Prompt lies(kLiningOutside);
  CHECK_FALSE(has(lies.last.text, "G0609"));
  CHECK(has(lies.enter("drape until rest settle preview", Outcome::unmet), "warning[G0609]"));
  CHECK_FALSE(has(lies.enter("drape until rest settle preview", Outcome::unmet), "G0609"));
}

TEST_CASE("a layer that comes to rest on the wrong side is told by each drape, and after an edit") {
  Prompt prompt(kLiningOutside);
  CHECK(has(prompt.enter("drape until rest settle preview", Outcome::unmet), "error[G0811]: `lining` is declared under `front`"));
  CHECK(has(prompt.last.text, "at rest: "));
  CHECK(has(prompt.enter("front.resolution = 1 cm", Outcome::unmet), "error[G0811]"));
  CHECK(has(prompt.enter("expect strain(all) < 50%"), "ok     "));
}
