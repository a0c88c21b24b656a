// SPDX-License-Identifier: GPL-3.0-or-later
// Checks each statement of a file by @learninglocker/xapi-validation and prints how many there are and what is wrong.
import {createRequire} from 'node:module';
import {readFileSync} from 'node:fs';
import path from 'node:path';

const [tools, file] = process.argv.slice(2);
const require = createRequire(path.join(path.resolve(tools), 'package.json'));
const validate = require('@learninglocker/xapi-validation').default;
const statements = JSON.parse(readFileSync(file, 'utf8'));
const wrong = statements.flatMap((one) => validate(one, ['statement']).map((warning) => JSON.stringify(warning)));
process.stdout.write(JSON.stringify({statements: statements.length, wrong}) + '\n');
