"""A small client of the Language Server Protocol, for tests: starts `garment lsp` and speaks with it."""
import json
import os
import queue
import subprocess
import threading


class Client:
    def __init__(self, program, *arguments):
        self.process = subprocess.Popen([program, "lsp", *arguments], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.incoming = queue.Queue()
        self.next_id = 1
        self.diagnostics = {}  # by uri, the last
        self.published = 0
        self.logs = []
        self.strays = []  # answers without an id
        threading.Thread(target=self._read, daemon=True).start()

    # ---- bytes

    def _read(self):
        out = self.process.stdout
        while True:
            length = None
            while True:
                line = out.readline()
                if not line:
                    self.incoming.put(None)
                    return
                line = line.strip()
                if not line:
                    break
                name, _, value = line.partition(b":")
                if name.lower() == b"content-length":
                    length = int(value)
            self.incoming.put(json.loads(out.read(length)))

    def send_bytes(self, data):
        self.process.stdin.write(data)
        self.process.stdin.flush()

    def send(self, message):
        body = json.dumps(message).encode()
        self.send_bytes(b"Content-Length: %d\r\n\r\n" % len(body) + body)

    # ---- messages

    def receive(self, timeout=60):
        message = self.incoming.get(timeout=timeout)
        if message is None:
            raise EOFError("the server left: exit code %s" % self.process.wait())
        if message.get("method") == "textDocument/publishDiagnostics":
            self.diagnostics[message["params"]["uri"]] = message["params"]["diagnostics"]
            self.published += 1
        elif message.get("method") == "window/logMessage":
            self.logs.append(message["params"]["message"])
        elif message.get("id") is None and "error" in message:
            self.strays.append(message["error"])
        return message

    def notify(self, method, params):
        self.send({"jsonrpc": "2.0", "method": method, "params": params})

    def ask(self, method, params):
        """Sends a request; gives its id."""
        id = self.next_id
        self.next_id += 1
        self.send({"jsonrpc": "2.0", "id": id, "method": method, "params": params})
        return id

    def answer_to(self, id):
        while True:
            message = self.receive()
            if message.get("id") == id and "method" not in message:
                return message

    def request(self, method, params):
        """The result of a request; an error comes as {"error": ...}."""
        message = self.answer_to(self.ask(method, params))
        return {"error": message["error"]} if "error" in message else message["result"]

    def wait_diagnostics(self, uri):
        self.diagnostics.pop(uri, None)
        while uri not in self.diagnostics:
            self.receive()
        return self.diagnostics[uri]

    # ---- the usual

    def start(self, encodings=None):
        general = {"positionEncodings": encodings} if encodings else {}
        result = self.request("initialize", {"processId": None, "rootUri": None, "capabilities": {"general": general}})
        self.notify("initialized", {})
        return result

    def open(self, uri, text, version=1):
        self.notify("textDocument/didOpen", {"textDocument": {"uri": uri, "languageId": "garment", "version": version, "text": text}})

    def change(self, uri, changes, version):
        self.notify("textDocument/didChange", {"textDocument": {"uri": uri, "version": version}, "contentChanges": changes})

    def at(self, method, uri, line, character, **more):
        return self.request("textDocument/" + method, {"textDocument": {"uri": uri}, "position": {"line": line, "character": character}, **more})

    def processor_seconds(self):
        """Processor time that the server used so far; 0 where the system does not tell."""
        try:
            fields = open("/proc/%d/stat" % self.process.pid).read().rsplit(")", 1)[1].split()
            return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
        except OSError:
            return 0

    def stop(self):
        result = self.request("shutdown", None)
        self.notify("exit", None)
        code = self.process.wait(timeout=30)
        return result, code


def units(text):
    """Length in UTF-16 code units."""
    return len(text.encode("utf-16-le")) // 2


def place(text, what, into=0, skip=0):
    """(line, character) of the place of `what` in a text, `into` characters further on."""
    at = -1
    for _ in range(skip + 1):
        at = text.index(what, at + 1)
    at += into
    line = text.count("\n", 0, at)
    begin = text.rfind("\n", 0, at) + 1
    return line, units(text[begin:at])


def apply(text, edits):
    """The text with LSP edits made."""
    lines = text.split("\n")
    starts = [0]
    for line in lines:
        starts.append(starts[-1] + len(line) + 1)

    def offset(position):
        line = lines[position["line"]]
        units_left, at = position["character"], 0
        while units_left > 0 and at < len(line):
            units_left -= units(line[at])
            at += 1
        return starts[position["line"]] + at

    for edit in sorted(edits, key=lambda e: (e["range"]["start"]["line"], e["range"]["start"]["character"]), reverse=True):
        begin, end = offset(edit["range"]["start"]), offset(edit["range"]["end"])
        text = text[:begin] + edit["newText"] + text[end:]
    return text
