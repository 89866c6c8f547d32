// Bundles src/ into the one page that the crate embeds: `npm ci && npm run build`.
//
// The page's policy names its script and its style by their hashes, so nothing else in it can run. The
// checksum of the sources in its first lines is what a test of the crate compares with src/.

import { createHash } from 'node:crypto';
import { readdirSync, readFileSync, writeFileSync, mkdirSync } from 'node:fs';
import { crc32 } from 'node:zlib';
import { build } from 'esbuild';

const licence = readFileSync('node_modules/three/LICENSE', 'utf8').trim();
const { version } = JSON.parse(readFileSync('node_modules/three/package.json', 'utf8'));

const bundle = async (entry) => {
  const result = await build({
    entryPoints: [entry],
    bundle: true,
    minify: true,
    charset: 'ascii',
    format: 'iife',
    target: ['es2022', 'chrome110', 'firefox110', 'safari16'],
    legalComments: 'none', // the whole text stands in the page
    write: false,
  });
  return result.outputFiles[0].text.trim();
};

const sources = readdirSync('src').sort();
const checksum = sources.reduce((sum, name) => crc32(readFileSync(`src/${name}`), sum), 0);
const script = await bundle('src/main.js');
const style = await bundle('src/page.css');
for (const [what, text] of [['script', script], ['style', style]]) {
  if (/<\/(script|style)|<!--/i.test(text)) throw new Error(`the ${what} would end its own element`);
}
const hash = (text) => `'sha256-${createHash('sha256').update(text).digest('base64')}'`;

const note = `<!-- Built from crates/viewer/web by npm run build; sources ${checksum}.
This page contains three.js r${version.split('.')[1]}, https://threejs.org:

${licence.replaceAll('--', '- -')}

The colours of viridis are by Nathaniel J. Smith and Stéfan van der Walt, CC0 1.0. -->`;

const page = readFileSync('src/page.html', 'utf8')
  .replace('{{note}}', () => note)
  .replace('{{script-hash}}', () => hash(script))
  .replace('{{style-hash}}', () => hash(style))
  .replace('{{style}}', () => style)
  .replace('{{script}}', () => script);

mkdirSync('../assets', { recursive: true });
writeFileSync('../assets/page.html', page);
writeFileSync('../assets/LICENSE-three.txt', `${licence}\n`);
console.log(`assets/page.html: ${page.length} bytes, three.js ${version}, sources ${checksum}`);
