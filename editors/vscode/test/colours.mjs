// Colours scripts with a TextMate engine and holds every token against the syntax tree of `garment parse --json`:
//     node test/colours.mjs [PROGRAM] [FILE ...]
// Without files: all examples, the standard library, and test/*.garment.
import { execFileSync } from "node:child_process";
import { readFileSync, readdirSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const require = createRequire(import.meta.url);
const oniguruma = require("vscode-oniguruma");
const textmate = require("vscode-textmate");

const here = dirname(fileURLToPath(import.meta.url));
const root = join(here, "../../..");
const program = process.argv[2] ?? join(root, "build/garment");
const scripts = (folder) => readdirSync(folder).filter((f) => f.endsWith(".garment")).map((f) => join(folder, f));
const files = process.argv.length > 3 ? process.argv.slice(3)
  : [...scripts(join(root, "examples")), ...scripts(join(root, "stdlib")), ...scripts(here)];

await oniguruma.loadWASM(readFileSync(require.resolve("vscode-oniguruma/release/onig.wasm")));
const registry = new textmate.Registry({
  onigLib: Promise.resolve({ createOnigScanner: (s) => new oniguruma.OnigScanner(s), createOnigString: (s) => new oniguruma.OnigString(s) }),
  loadGrammar: async () => textmate.parseRawGrammar(readFileSync(join(here, "../syntaxes/garment.tmLanguage.json"), "utf8"), "garment.json"),
});
const grammar = await registry.loadGrammar("source.garment");

/** Scopes of every UTF-16 position of a text. */
function colours(text) {
  const scopes = [];
  let stack = textmate.INITIAL;
  for (const line of text.split("\n")) {
    const result = grammar.tokenizeLine(line, stack);
    for (const token of result.tokens)
      for (let i = token.startIndex; i < Math.min(token.endIndex, line.length); ++i) scopes.push(token.scopes);
    scopes.push([]);
    stack = result.ruleStack;
  }
  return scopes;
}

const kinds = {
  keyword: /keyword\.(other|control)\.garment/,
  clause: /keyword\.other\.clause|keyword\.operator\.garment|punctuation\.separator/,
  name: /entity\.name/,
  number: /constant\.numeric/,
  unit: /keyword\.other\.unit/,
  string: /string\.quoted/,
  comment: /comment\./,
  word: /variable|support|entity\.name/,
  member: /variable\.other\.member|entity\.name\.function/,
  boolean: /constant\.language\.boolean/,
};
const plain = /keyword\.(?!operator)|constant\.numeric/;  // what no comment and no literal text may hold

const shapes = new Set(["within", "above", "below", "left", "right", "not"]);

/** What the tree says of a text: [begin, end, kind] in bytes. */
function expected(tree, bytes) {
  const out = [];
  const slice = (begin, end) => bytes.subarray(begin, end).toString();
  function walk(expr, string) {
    const [begin, end] = expr.span;
    if (expr.kind === "number") {
      const text = slice(begin, end), digits = text.match(/^[0-9.]+([eE][+-]?[0-9]+)?/)[0].length;
      out.push([begin, begin + digits, "number"]);
      if (expr.unit) out.push([end - Buffer.byteLength(expr.unit), end, "unit"]);
    } else if (expr.kind === "string") {
      out.push([begin, begin + 1, "string"]);
      if (!expr.children) out.push([begin, end, "string"]);
    } else if (expr.kind === "boolean") {
      out.push([begin, end, "boolean"]);
    } else if (expr.kind === "name" && !expr.children) {
      out.push([begin, end, "word"]);
    } else if (expr.kind === "member" && expr.children.length === 1) {
      out.push([end - expr.text.length, end, "member"]);
    }
    for (const child of expr.children ?? []) if (child.kind !== "text" && child.kind !== "none") walk(child, string);
  }
  function block(statements) {
    for (const s of statements) {
      const [begin] = s.span;
      if (s.keyword !== "=") out.push([begin, begin + s.keyword.split(" ")[0].length, "keyword"]);
      if (s.name && !s.name.parts) out.push([...s.name.span, "name"]);
      const second = s.keyword === "replace" || s.keyword === "pair";
      (s.operands ?? []).forEach((operand, k) => {
        if (second && k < 2) out.push([...operand.span, k === 0 ? "keyword" : "name"]);
        else if ((s.keyword === "fn" || s.keyword === "component") && operand.kind === "call") {
          out.push([...operand.children[0].span, "name"]);
          operand.children.slice(1).forEach((c) => walk(c));
        } else walk(operand);
      });
      for (const clause of s.clauses ?? []) {
        if (!(s.keyword === "if")) out.push([clause.span[0], clause.span[0] + clause.word.length, "clause"]);
        // The first shape of a region stands right after the colon; its word is coloured as the others are.
        clause.values.forEach((v, k) => {
          const shape = s.keyword === "region" && clause.word === ":" && k === 0 && v.kind === "name" && clause.values.length > 1;
          if (shape && shapes.has(slice(...v.span))) out.push([...v.span, "clause"]);
          else walk(v);
        });
      }
      if (s.body) block(s.body);
      if (s.else) block(s.else);
    }
  }
  block(tree.statements);
  return out;
}

/** Comments by the rule of the language alone: a # outside strings. */
function comments(bytes) {
  const out = [], text = bytes.toString("latin1");
  for (let i = 0; i < text.length; ++i) {
    if (text[i] === '"') {
      for (++i; i < text.length && text[i] !== '"' && text[i] !== "\n"; ++i) if (text[i] === "\\") ++i;
    } else if (text[i] === "#") {
      const begin = i;
      while (i < text.length && text[i] !== "\n") ++i;
      out.push([begin, i, "comment"]);
    }
  }
  return out;
}

let failed = 0, checked = 0;
for (const file of files) {
  const bytes = readFileSync(file), text = bytes.toString();
  const scopes = colours(text);
  const tree = JSON.parse(execFileSync(program, ["parse", "--json", file], { maxBuffer: 1 << 28 }).toString());
  const unitAt = (byte) => bytes.subarray(0, byte).toString().length;
  for (const [begin, end, kind] of [...expected(tree, bytes), ...comments(bytes)]) {
    const from = unitAt(begin), to = unitAt(end);
    ++checked;
    for (let i = from; i < to; ++i) {
      const all = scopes[i].join(" "), inner = scopes[i][scopes[i].length - 1] ?? "";
      const fits = kinds[kind].test(kind === "string" || kind === "comment" ? all : inner) && !((kind === "comment" || kind === "string") && plain.test(all));
      if (fits) continue;
      const line = text.slice(0, i).split("\n").length;
      if (++failed <= 30) console.error(`${file}:${line}: \`${text.slice(from, to)}\` is a ${kind}, coloured as ${all}`);
      break;
    }
  }
}
console.log(`colours: ${files.length} files, ${checked} tokens, ${failed} failed`);
process.exit(failed > 0 || checked < 500 ? 1 : 0);
