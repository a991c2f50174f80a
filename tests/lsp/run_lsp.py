#!/usr/bin/env python3
"""Speaks the Language Server Protocol with `garment lsp`: run_lsp.py PROGRAM SOURCE_DIR [--update].

Every request of the server is asked in a script with characters beyond the basic plane; answers that are long are held
against goldens in tests/lsp/golden (written anew with --update). Exit code 1 if a check fails.
"""
import json
import os
import random
import sys
import tempfile
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from client import Client, apply, place, units  # noqa: E402

PROGRAM, ROOT = sys.argv[1], sys.argv[2]
UPDATE = "--update" in sys.argv
GOLDEN = os.path.join(ROOT, "tests/lsp/golden")
failures = []
n_checks = 0

SCRIPT = """garment 1 "𝒮kirt 👗" # 🧵 thread
use fabrics, bodies
## waist to hem 📏
param long = 58 cm in 30 cm .. 110 cm "long 👗"
let 	w = 20 cm
fn half(x: length, n: number = 2) = x / n
body form = bodies.woman(size: 40)
fabric shell = fabrics.denim
panel front of shell on fold cf {
  outline from (0, 0) {
    edge hem to (30 cm, 0) free
    edge side to (22 cm, long) ; edge waist to (0, long) # 👗👗
    close cf
  }
  dart waist_dart on waist at 50% width 2 cm depth 9 cm
}
panel back of shell like front {
  rename cf as cb
}
both seam side: front.side to back.side
place front on form.front with waist at form.waist
place back on form.back with waist at form.waist
measure mid = half(w, n: 4)
"""


def check(name, holds, detail=""):
    global n_checks
    n_checks += 1
    if not holds:
        failures.append(name)
        print("FAILED: %s %s" % (name, detail))


def same(name, found, expected):
    check(name, found == expected, "\n  found    %r\n  expected %r" % (found, expected))


def golden(name, value):
    """Holds a value against its golden."""
    text = json.dumps(value, indent=1, ensure_ascii=False, sort_keys=True).replace(ROOT, "ROOT") + "\n"
    path = os.path.join(GOLDEN, name + ".json")
    if UPDATE:
        os.makedirs(GOLDEN, exist_ok=True)
        open(path, "w", encoding="utf-8").write(text)
        return
    expected = open(path, encoding="utf-8").read() if os.path.exists(path) else ""
    if text != expected:
        import difflib
        diff = "\n".join(list(difflib.unified_diff(expected.split("\n"), text.split("\n"), "golden", "found", lineterm=""))[:40])
        check("golden " + name, False, "\n" + diff)
    else:
        check("golden " + name, True)


def text_of(text, range):
    """What a range covers."""
    mark = "\0"
    with_end = apply(text, [{"range": {"start": range["end"], "end": range["end"]}, "newText": mark}])
    both = apply(with_end, [{"range": {"start": range["start"], "end": range["start"]}, "newText": mark}])
    return both.split(mark)[1]


def started():
    client = Client(PROGRAM)
    client.start()
    return client


def test_life():
    client = Client(PROGRAM)
    same("request before initialize", client.request("textDocument/hover", {})["error"]["code"], -32002)
    result = client.start()
    same("utf-16 unless asked otherwise", result["capabilities"]["positionEncoding"], "utf-16")
    golden("capabilities", {k: v for k, v in result.items() if k != "serverInfo"})
    same("second initialize", client.request("initialize", {})["error"]["code"], -32600)
    same("unknown request", client.request("garment/nothing", {})["error"]["code"], -32601)
    same("file that is not open", client.at("hover", "file:///x.garment", 0, 0)["error"]["code"], -32602)
    same("shutdown", client.stop(), (None, 0))
    client = started()
    client.notify("exit", None)
    same("exit without shutdown", client.process.wait(timeout=30), 1)
    client = started()
    client.process.stdin.close()
    same("end of input", client.process.wait(timeout=30), 1)


def test_answers():
    client, uri = started(), "file:///tmp/skirt%20one.garment"
    client.open(uri, SCRIPT)
    same("the script is right", [d for d in client.wait_diagnostics(uri) if d["severity"] == 1], [])

    def hover(what, into=0, skip=0):
        return client.at("hover", uri, *place(SCRIPT, what, into, skip))

    side = hover("edge side", 6)
    same("hover covers the word", text_of(SCRIPT, side["range"]), "side")
    golden("hover", {w: hover(*w.split("@")[:1], *(int(n) for n in w.split("@")[1:])) for w in (
        "edge side@6", "waist to (0@1", "long =@1", "panel front@1", "front.side@8", "form.waist@6", "half(w@1",
        "bodies.woman@8", "shell like@1", "waist_dart on@2", "58 cm in@1", "both seam@1")})
    same("nothing to tell in a comment", hover("🧵"), None)
    same("nothing to tell in text", hover("👗"), None)

    definition = client.at("definition", uri, *place(SCRIPT, "back.side", 6))
    same("definition", [text_of(SCRIPT, d["range"]) for d in definition], ["side"])
    same("definition's line", definition[0]["range"]["start"]["line"], place(SCRIPT, "edge side")[0])
    library = client.at("definition", uri, *place(SCRIPT, "bodies.woman", 8))
    check("definition in a library", library[0]["uri"].endswith("/stdlib/bodies.garment"), library)
    check("definition of a library", client.at("definition", uri, *place(SCRIPT, "bodies.woman", 1))[0]["uri"].endswith("/stdlib/bodies.garment"))

    uses = client.at("references", uri, *place(SCRIPT, "edge side", 6), context={"includeDeclaration": True})
    same("uses", [text_of(SCRIPT, u["range"]) for u in uses], ["side"] * 3)
    same("uses without the declaration", len(client.at("references", uri, *place(SCRIPT, "edge side", 6), context={"includeDeclaration": False})), 2)
    marks = client.at("documentHighlight", uri, *place(SCRIPT, "edge waist", 6))
    same("highlights", [text_of(SCRIPT, m["range"]) for m in marks], ["waist"] * 4)

    partner = client.at("implementation", uri, *place(SCRIPT, "edge side", 6))
    same("seam partner", [text_of(SCRIPT, p["range"]) for p in partner], ["side"])
    same("seam partner by its own request", client.request("garment/seamPartners", {
        "textDocument": {"uri": uri}, "position": dict(zip(("line", "character"), place(SCRIPT, "front.side", 8)))}), partner)

    symbols = client.request("textDocument/documentSymbol", {"textDocument": {"uri": uri}})
    golden("symbols", symbols)
    golden("folding", client.request("textDocument/foldingRange", {"textDocument": {"uri": uri}}))
    tokens = client.request("textDocument/semanticTokens/full", {"textDocument": {"uri": uri}})["data"]
    check("semantic tokens", len(tokens) > 200 and len(tokens) % 5 == 0, len(tokens))
    line = character = 0
    words = []
    for k in range(0, len(tokens), 5):
        character = tokens[k + 1] + (0 if tokens[k] else character)
        line += tokens[k]
        words.append(text_of(SCRIPT, {"start": {"line": line, "character": character}, "end": {"line": line, "character": character + tokens[k + 2]}}))
    check("semantic tokens are words", all(w.replace("_", "a").isalnum() for w in words), words)
    check("no token in comments and texts", "thread" not in words and "kirt" not in words, words)

    signature = client.at("signatureHelp", uri, *place(SCRIPT, "half(w, n: 4", 11))
    golden("signature", signature)
    same("no signature outside a call", client.at("signatureHelp", uri, 0, 0), None)

    formatted = client.request("textDocument/formatting", {"textDocument": {"uri": uri}, "options": {"tabSize": 2, "insertSpaces": True}})
    again = apply(SCRIPT, formatted)
    check("formatted", "let w = 20 cm" in again and "👗👗" in again, again)
    client.change(uri, [{"text": again}], 2)
    same("formatting twice", client.request("textDocument/formatting", {"textDocument": {"uri": uri}, "options": {}}), [])
    client.stop()


def test_rename():
    client, uri = started(), "file:///tmp/rename.garment"
    client.open(uri, SCRIPT)
    client.wait_diagnostics(uri)
    for what, into, name, count in (("edge side", 6, "flank", 3), ("shell = ", 1, "cloth", 3), ("waist_dart on", 2, "pinch", 1),
                                    ("rename cf", 8, "middle", 3), ("form = ", 1, "lady", 5), ("x / n", 0, "much", 2), ("n: 4", 0, "parts", 3)):
        line, character = place(SCRIPT, what, into)
        old = client.at("prepareRename", uri, line, character)
        edits = client.at("rename", uri, line, character, newName=name)
        if "error" in edits:
            check("rename " + what, False, edits)
            continue
        edits = edits["changes"][uri]
        same("rename %s: uses" % what, len(edits), count)
        check("rename %s: the old name" % what, all(text_of(SCRIPT, e["range"]) == old["placeholder"] for e in edits), edits)
        text = apply(SCRIPT, edits)
        client.change(uri, [{"text": text}], 2)
        same("rename %s: still right" % what, [d for d in client.wait_diagnostics(uri) if d["severity"] == 1], [])
        line, character = place(text, name)
        back = client.at("rename", uri, line, character, newName=old["placeholder"])
        same("rename %s: and back" % what, apply(text, back["changes"][uri]), SCRIPT)
        client.change(uri, [{"text": SCRIPT}], 3)
        client.wait_diagnostics(uri)
    for what, into, name, code in (("long =", 1, "w", "G0302"), ("long =", 1, "cm", "G0303"), ("long =", 1, "pi", "G0303"),
                                   ("long =", 1, "a b", "G1560"), ("denim", 1, "jeans", "G1561"), ("edge side", 6, "waist", "G0302")):
        error = client.at("rename", uri, *place(SCRIPT, what, into), newName=name)
        check("rename %s to %s is refused" % (what, name), "error" in error and code in error["error"]["message"], error)
    check("no rename of a keyword", "error" in client.at("prepareRename", uri, *place(SCRIPT, "panel front", 1)))
    client.stop()


def labels(completion):
    return [i["label"] for i in completion["items"]]


def test_completion():
    client, uri = started(), "file:///tmp/completion.garment"
    client.open(uri, SCRIPT)
    client.wait_diagnostics(uri)
    version = 1
    for typed, want, reject in (("seam s: front.left.", ["side", "waist"], ["cm", "seam"]), ("place front on form.", ["front", "waist"], ["w"]),
                                ("pa", ["panel", "param"], ["seam"]), ("fabric f = fabrics.ha", ["habotai"], ["denim"]),
                                ("let x = 3 ", ["cm", "inch"], ["w"]), ("drape until rest settle ", ["exact"], ["until"]),
                                ("let 👗 = front.", [], []), ("body b = bodies.woman(", ["bust:", "size:"], [])):
        version += 1
        client.change(uri, [{"text": SCRIPT + typed}], version)
        line, character = place(SCRIPT + typed + "\0", "\0")
        found = client.at("completion", uri, line, character)
        check("completion after `%s`" % typed, all(w in labels(found) for w in want) and not any(r in labels(found) for r in reject), labels(found)[:20])
    client.change(uri, [{"text": SCRIPT + "let y = lon + 1 cm\n"}], version + 1)
    found = client.at("completion", uri, *place(SCRIPT + "let y = lon + 1 cm\n", "lon +", 2))
    item = [i for i in found["items"] if i["label"] == "long"][0]
    check("completion replaces the word", apply(SCRIPT + "let y = lon + 1 cm\n", [item["textEdit"]]).endswith("let y = long + 1 cm\n"))
    golden("completion_item", item)
    client.stop()


def test_diagnostics():
    client, uri = started(), "file:///tmp/wrong.garment"
    text = "use fabrics\nlet a = 2 cm # 👗\nlet b = \"👗👗\" ; let c = aa + 1 cm\n"
    client.open(uri, text)
    found = client.wait_diagnostics(uri)
    golden("diagnostics", found)
    unknown = [d for d in found if d["code"] == "G0301"][0]
    same("a place behind emoji", text_of(text, unknown["range"]), "aa")
    other, double = "file:///tmp/twice.garment", "let a = 2 cm # 👗\nlet a = 3 cm\n"
    client.open(other, double)
    twice = client.wait_diagnostics(other)
    golden("diagnostics_related", twice)
    same("related places", text_of(double, twice[0]["relatedInformation"][0]["location"]["range"]), "a")
    actions = client.request("textDocument/codeAction", {"textDocument": {"uri": uri}, "range": unknown["range"], "context": {"diagnostics": [unknown]}})
    if actions:
        text = apply(text, actions[0]["edit"]["changes"][uri])
    check("a quick fix", "let c = a + 1 cm" in text, actions)
    # An incremental change behind emoji, two in one message: the second counts from the text after the first.
    changes = [{"range": {"start": dict(line=2, character=8), "end": dict(line=2, character=14)}, "text": "\"é\""},
               {"range": {"start": dict(line=3, character=0), "end": dict(line=3, character=0)}, "text": "let d = 3 cm\n"}]
    client.change(uri, changes, 2)
    same("incremental changes", [d["code"] for d in client.wait_diagnostics(uri)], ["G0301"])
    client.change(uri, [{"range": {"start": dict(line=2, character=22), "end": dict(line=2, character=24)}, "text": "a"}], 3)
    same("incremental changes mend it", client.wait_diagnostics(uri), [])
    client.notify("textDocument/didSave", {"textDocument": {"uri": uri}})
    same("save", client.wait_diagnostics(uri), [])
    client.change(uri, [{"text": "panel p of {\n"}], 4)
    check("broken text", len(client.wait_diagnostics(uri)) >= 1)
    client.notify("textDocument/didClose", {"textDocument": {"uri": uri}})
    same("closed files show nothing", client.wait_diagnostics(uri), [])
    client.stop()


def test_model_laws():
    client, uri = started(), "file:///tmp/model.garment"
    client.open(uri, open(os.path.join(ROOT, "tests/golden/model/too_small.garment"), encoding="utf-8").read())
    found = client.wait_diagnostics(uri)
    client.at("hover", uri, 0, 0)
    while not found:
        found = client.wait_diagnostics(uri)
    check("laws of the model", any(d["code"].startswith("G0") for d in found), found)
    client.stop()


def test_files():
    with tempfile.TemporaryDirectory() as folder:
        part = os.path.join(folder, "my part.garment")
        open(part, "w").write("let wide = 30 cm\n")
        main = "file://" + folder.replace(" ", "%20") + "/main.garment"
        part_uri = "file://" + part.replace(" ", "%20")
        client = started()
        text = "use \"my part.garment\" as part\nlet w = part.wide + 1 cm\n"
        client.open(main, text)
        same("a used file", client.wait_diagnostics(main), [])
        found = client.at("definition", main, *place(text, "wide", 1))
        same("definition in a used file", [(d["uri"], d["range"]["start"]["line"]) for d in found], [(part_uri, 0)])
        client.open(part_uri, "let wide = 30 deg\n")
        broken = []
        while not broken:
            broken = client.wait_diagnostics(main)
        same("an open file counts as the editor has it", [d["code"] for d in broken], ["G0305"])
        client.change(part_uri, [{"text": "let wide = \n"}], 2)
        while not client.diagnostics.get(part_uri):
            client.receive()
        check("mistakes of a used file are shown in it", client.diagnostics[part_uri][0]["range"]["start"]["line"] == 0)
        client.change(part_uri, [{"text": "let wide = 31 cm\n"}], 3)
        while client.diagnostics.get(main) != [] or client.diagnostics.get(part_uri) != []:
            client.receive()
        check("and mended there", True)
        client.stop()


def test_bad_messages():
    client = started()
    body = b'{"jsonrpc": "2.0", "id": 77, "method": '
    client.send_bytes(b"Content-Length: %d\r\n\r\n" % len(body) + body)
    client.send_bytes(b"Content-Length: 2\r\n\r\n[]")
    client.send_bytes(b"Content-Length: 4\r\n\r\n\xff\xfe\xfd\xfc")
    client.send_bytes(b"Nonsense\r\n\r\n")
    client.send_bytes(b"X-Long: " + b"x" * 100000 + b"\r\nContent-Length: zero\r\n\r\n")
    deep = b"[" * 100000 + b"]" * 100000
    client.send_bytes(b"Content-Length: %d\r\n\r\n" % len(deep) + deep)
    huge = 40 << 20
    client.send_bytes(b"Content-Length: %d\r\n\r\n" % huge + b" " * huge)
    client.send({"jsonrpc": "2.0", "id": {"a": 1}, "method": "textDocument/hover"})
    client.send({"jsonrpc": "2.0", "id": 5})
    for method, params in (("textDocument/didOpen", {}), ("textDocument/didOpen", {"textDocument": {"uri": 3}}), ("textDocument/didChange", 7),
                           ("textDocument/didChange", {"textDocument": {"uri": "file:///no"}, "contentChanges": [{"text": "x"}]})):
        client.notify(method, params)
    same("requests go on after bad messages", client.request("textDocument/hover", {"textDocument": []})["error"]["code"], -32602)
    uri = "file:///tmp/bad.garment"
    client.open(uri, "let a = 2 cm\n")
    for position in ({"line": -5, "character": -1}, {"line": 10**9, "character": 10**9}, {"line": "x"}, {}):
        for method in ("hover", "completion", "definition", "references", "rename", "prepareRename", "signatureHelp"):
            client.request("textDocument/" + method, {"textDocument": {"uri": uri}, "position": position, "newName": "b"})
    same("bad messages are answered", len(client.strays), 8)
    check("with the codes of JSON-RPC", all(e["code"] in (-32700, -32600) for e in client.strays), client.strays)
    same("shutdown after bad messages", client.stop(), (None, 0))


def test_cancel():
    client, uri = started(), "file:///tmp/cancel.garment"
    slow = "fn f(n) = if n < 1 { 0 } else { f(n - 1) + f(n - 1) }\nlet a = f(14)\n"
    client.open(uri, slow)
    ids = [client.ask("textDocument/hover", {"textDocument": {"uri": uri}, "position": {"line": 0, "character": 3}}) for _ in range(20)]
    client.notify("$/cancelRequest", {"id": ids[-1]})
    answers = [client.answer_to(i) for i in ids]
    check("all are answered", all("result" in a or a["error"]["code"] == -32800 for a in answers))
    # The last may have been answered before the cancellation came in.
    check("a cancelled request", "result" in answers[-1] or answers[-1]["error"]["code"] == -32800)
    before = client.published
    for version in range(2, 60):
        client.change(uri, [{"text": slow + "# %d\n" % version}], version)
    client.at("hover", uri, 0, 3)
    check("fast typing is interpreted less often than it comes", client.published - before < 50, client.published - before)
    client.stop()


def test_encodings():
    for encoding, width in (("utf-8", 4), ("utf-32", 1), ("utf-16", 2)):
        client, uri = Client(PROGRAM), "file:///tmp/e.garment"
        same("encoding", client.start([encoding])["capabilities"]["positionEncoding"], encoding)
        client.open(uri, "let a = \"👗\" + b\n")
        found = client.wait_diagnostics(uri)
        same("columns in " + encoding, found[0]["range"]["start"]["character"], 8 + 2 + width + 3)
        client.stop()


def test_random_edits():
    """500 random edits, each as the protocol sends it; the server's text must stay that of the client, and answer."""
    rng = random.Random(7)
    files = [open(os.path.join(ROOT, "examples", f), encoding="utf-8").read() for f in sorted(os.listdir(os.path.join(ROOT, "examples"))) if f.endswith(".garment")]
    pieces = ["{", "}", "(", ")", "\"", "👗", "\n", " ", "panel ", "front", ".", "seam s: ", "12 cm", "#", "=", "[", "]", "..", "é", "\t", "edge ", "like ", ";", "{x}", "fn f(x) = "]
    client, uri = started(), "file:///tmp/fuzz.garment"
    text = SCRIPT
    client.open(uri, text)
    version = 1
    for step in range(500):
        if step % 60 == 59:
            text = rng.choice(files + [SCRIPT])
            changes = [{"text": text}]
        else:
            begin = rng.randrange(len(text) + 1)
            end = min(len(text), begin + rng.choice((0, 0, 1, 3, 20)))
            new = rng.choice(pieces) if rng.random() < 0.8 else text[rng.randrange(len(text) + 1):][:15]
            if not text:
                new = SCRIPT
            ends = [dict(zip(("line", "character"), place(text + "\0", (text + "\0")[i:], 0))) for i in (begin, end)]
            changes = [{"range": {"start": ends[0], "end": ends[1]}, "text": new}]
            text = text[:begin] + new + text[end:]
        version += 1
        client.change(uri, changes, version)
        at = rng.randrange(len(text) + 1)
        line, character = place(text + "\0", (text + "\0")[at:], 0)
        method = rng.choice(("hover", "completion", "definition", "references", "documentHighlight", "implementation", "signatureHelp", "prepareRename", "rename"))
        result = client.at(method, uri, line, character, newName="zz")
        if isinstance(result, dict) and "error" in result:
            check("random edit %d, %s" % (step, method), result["error"]["code"] == -32803, result)
        if step % 10 == 0:
            for method in ("documentSymbol", "foldingRange", "semanticTokens/full", "formatting"):
                client.request("textDocument/" + method, {"textDocument": {"uri": uri}, "options": {}})
    same("the server lives after 500 random edits", client.stop(), (None, 0))


def test_latency():
    """Time from a change to its diagnostics on the largest example: printed; the processor's time is bounded, since other
    programs do not count in it."""
    examples = [os.path.join(ROOT, "examples", f) for f in os.listdir(os.path.join(ROOT, "examples")) if f.endswith(".garment")]
    path = max(examples, key=os.path.getsize)
    text = open(path, encoding="utf-8").read()
    client, uri = started(), "file://" + path
    client.open(uri, text)
    client.wait_diagnostics(uri)
    times = []
    before = client.processor_seconds()
    for version in range(2, 12):
        begin = time.perf_counter()
        client.change(uri, [{"text": text + "# %d\n" % version}], version)
        client.wait_diagnostics(uri)
        times.append(time.perf_counter() - begin)
        time.sleep(0.05)
    median = sorted(times)[len(times) // 2]
    spent = (client.processor_seconds() - before) / len(times)
    print("didChange to diagnostics on %s: median %.0f ms, most %.0f ms, of the processor %.0f ms" % (
        os.path.basename(path), 1e3 * median, 1e3 * max(times), 1e3 * spent))
    check("processor time of a change", spent < 0.1, spent)
    client.stop()


for name, test in list(globals().items()):
    if name.startswith("test_"):
        try:
            test()
        except (OSError, EOFError, KeyError, TypeError, ValueError, IndexError) as error:
            import traceback
            traceback.print_exc()
            check(name, False, repr(error))
print("lsp: %d checks, %d failed" % (n_checks, len(failures)))
sys.exit(1 if failures else 0)
