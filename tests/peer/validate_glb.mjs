// node validate_glb.mjs FILE.glb...: the Khronos validator; exit 1 on any error or warning.
import { readFileSync } from 'node:fs';
import validator from 'gltf-validator';

let failed = process.argv.length < 3;
for (const path of process.argv.slice(2)) {
  const report = await validator.validateBytes(new Uint8Array(readFileSync(path)), { maxIssues: 20 });
  const { numErrors, numWarnings, numInfos, messages } = report.issues;
  console.log(`${path}: ${numErrors} errors, ${numWarnings} warnings, ${numInfos} infos`);
  for (const m of messages) console.log(`  ${m.code} ${m.pointer}: ${m.message}`);
  failed ||= numErrors + numWarnings > 0;
}
process.exit(failed ? 1 : 0);
