// Prints one line per file and one per message of Khronos' glTF validator. Started by scripts/validate_gltf.
'use strict';

const fs = require('fs');
const validator = require('gltf-validator');

const severities = ['error', 'warning', 'info', 'hint'];

async function validate(file) {
    const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)), {
        uri: file,
        maxIssues: 20,
        writeTimestamp: false,
    });
    const { numErrors, numWarnings, numInfos, numHints, messages } = report.issues;
    console.log(`${file}: ${numErrors} errors, ${numWarnings} warnings, ${numInfos} infos, ${numHints} hints`);
    for (const { severity, code, message, pointer } of messages) {
        console.log(`  ${severities[severity]} ${code} ${pointer || ''}: ${message}`);
    }
    return numErrors;
}

async function main() {
    let errors = 0;
    for (const file of process.argv.slice(2)) {
        try {
            errors += await validate(file);
        } catch (problem) {  // not there, or not glTF at all
            console.log(`${file}: ${problem.message || problem}`);
            errors += 1;
        }
    }
    process.exit(errors === 0 ? 0 : 1);
}

main();
