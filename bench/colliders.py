#!/usr/bin/env python3
"""Measures what colliders cost: a falling sheet of 128² with 0 … 10,000 balls, on one thread.

far: at rest, 50 m away. moving: the same, each with a motion by keys. pegs: on a grid under the sheet, which falls on
them. Prints the median and the largest time of a frame, and the median of its contact passes.

    WEFT=build/release/apps/cli/weft bench/colliders.py [--frames N] [--backend cpu|vulkan]
"""
import argparse
import json
import os
import subprocess
import tempfile

COUNTS = (0, 1, 10, 100, 1000, 10000)


def collider(kind, i, side):
    column, row = i % side, i // side
    if kind == 'pegs':
        place = [-1 + 2 * column / side, 0, -1 + 2 * row / side]
        return {'sphere': {'radius': min(0.1, 0.6 / side)}, 'transform': {'position': place}}
    place = [50 + 0.5 * column, 0, 0.5 * row]
    made = {'sphere': {'radius': 0.05}, 'transform': {'position': place}}
    if kind == 'moving':
        end = [place[0] + 5, 1, place[2]]
        made['motion'] = {'keys': [{'time': 0, 'position': place, 'rotation': [0, 0, 0]},
                                   {'time': 100, 'position': end, 'rotation': [0, 300, 0]}]}
    return made


def scene(kind, count):
    side = max(1, round(count ** 0.5))
    return {'weft': 1,
            'cloths': [{'mesh': {'grid': {'size': [1, 1], 'resolution': [128, 128]}},
                        'transform': {'position': [0, 0.3, 0]}}],
            'colliders': [collider(kind, i, side) for i in range(count)]}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--frames', default='60')
    parser.add_argument('--backend', default='cpu')
    args = parser.parse_args()
    weft = os.environ.get('WEFT', 'build/release/apps/cli/weft')
    with tempfile.TemporaryDirectory() as folder:
        path, stats = os.path.join(folder, 'scene.json'), os.path.join(folder, 'stats.json')
        print('colliders          frame, ms         contact')
        print('                   median   largest  median')
        for kind in ('far', 'moving', 'pegs'):
            for count in COUNTS:
                with open(path, 'w', encoding='utf-8') as file:
                    json.dump(scene(kind, count), file)
                subprocess.run([weft, 'run', path, '--frames', args.frames, '--threads', '1', '--quiet', '--backend',
                                args.backend, '--stats', stats], check=True)
                with open(stats, encoding='utf-8') as file:
                    got = json.load(file)
                ms = got['ms_per_frame']
                print(f"{kind:8} {count:6}  {ms['median']:9.2f} {ms['max']:9.2f} {got['stage_ms']['contact']:8.3f}"
                      f"   {got['state_hash']}", flush=True)


if __name__ == '__main__':
    main()
