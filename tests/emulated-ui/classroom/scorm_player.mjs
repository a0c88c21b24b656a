// SPDX-License-Identifier: GPL-3.0-or-later
// A SCORM 1.2 player (scorm-again) with the page of a package in it (jsdom). Takes the folder of an unpacked package, a
// user name and files to hand in, one after the other; prints what the player has after each, as JSON lines.
import {createRequire} from 'node:module';
import {readFileSync} from 'node:fs';
import path from 'node:path';
import {pathToFileURL} from 'node:url';

const [tools, folder, student, ...files] = process.argv.slice(2);
const require = createRequire(path.join(path.resolve(tools), 'package.json'));
const {JSDOM, VirtualConsole} = require('jsdom');
const {Scorm12API} = await import(pathToFileURL(path.join(path.resolve(tools), 'node_modules/scorm-again/dist/esm/scorm12.js')).href);

for (const file of files) {
  const api = new Scorm12API({autocommit: false, logLevel: 5});
  api.loadFromJSON({core: {student_id: student, credit: 'credit', lesson_mode: 'normal'}}, 'cmi');
  const console = new VirtualConsole();
  console.on('jsdomError', (error) => process.stdout.write(JSON.stringify({error: String(error)}) + '\n'));
  const dom = await JSDOM.fromFile(path.join(folder, 'index.html'), {
    runScripts: 'dangerously', resources: 'usable', virtualConsole: console,
    beforeParse(window) {
      window.API = api;
      window.TextEncoder = TextEncoder;
      window.Uint8Array = Uint8Array;
    }
  });
  await new Promise((loaded) => dom.window.addEventListener('load', loaded));
  const accepted = dom.window.report(readFileSync(file, 'utf8'));
  const said = dom.window.document.getElementById('said').textContent;
  const {core, interactions, suspend_data} = api.cmi;
  const state = {accepted, said, raw: core.score.raw, status: core.lesson_status, suspend_data,
                 interactions: interactions.childArray.map((one) => one.toJSON()).map(({id, type, result}) => ({id, type, result}))};
  dom.window.dispatchEvent(new dom.window.Event('pagehide'));
  process.stdout.write(JSON.stringify({...state, after: core.lesson_status, last_error: api.LMSGetLastError(),
                                       terminated: api.isTerminated()}) + '\n');
  dom.window.close();
}
