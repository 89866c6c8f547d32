// Prints what the Khronos validator says of a file, as JSON.
import fs from 'node:fs';
import validator from 'gltf-validator';

const bytes = new Uint8Array(fs.readFileSync(process.argv[2]));
const { issues } = await validator.validateBytes(bytes);
console.log(JSON.stringify(issues));
