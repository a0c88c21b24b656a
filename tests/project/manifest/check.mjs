// SPDX-License-Identifier: GPL-3.0-or-later
// check.mjs TOOLS SHAPES.ttl FILE...: each JSON-LD file against shapes, by npm's jsonld, n3, rdf-ext and shacl-engine in
// TOOLS, without a network. Prints a line of JSON for each: quads, conforms, and where it does not.
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { pathToFileURL } from 'node:url';

const [tools, shapesFile, ...files] = process.argv.slice(2);
const require = createRequire(pathToFileURL(`${tools}/package.json`));
const load = async (name) => {
  const found = await import(pathToFileURL(require.resolve(name)).href);
  return found.default ?? found;
};
const jsonld = await load('jsonld');
const n3 = await load('n3');
const rdf = await load('rdf-ext');
const { Validator } = await import(pathToFileURL(require.resolve('shacl-engine')).href);

const datasetOf = (quads) => rdf.dataset(new n3.Parser({ factory: rdf }).parse(quads));
const shapes = datasetOf(readFileSync(shapesFile, 'utf8'));
const noNetwork = async (url) => { throw new Error(`${url}: the context must be inline`); };
for (const file of files) {
  const nquads = await jsonld.toRDF(JSON.parse(readFileSync(file, 'utf8')),
                                    { format: 'application/n-quads', documentLoader: noNetwork, base: 'urn:set:' });
  const dataset = rdf.dataset(new n3.Parser({ format: 'N-Quads', factory: rdf }).parse(nquads));
  const report = await new Validator(shapes, { factory: rdf }).validate({ dataset });
  const where = report.results.map((r) => `${r.focusNode?.term?.value ?? r.focusNode?.value} ` +
                                          `${(r.path?.[0]?.predicates?.[0] ?? r.path)?.value ?? ''}`);
  console.log(JSON.stringify({ quads: dataset.size, conforms: report.conforms, where }));
}
