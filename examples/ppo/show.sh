#!/bin/sh
# PPO teaches GoToObject, and Collect drives with it: sh examples/ppo/show.sh FOLDER [TICKS [SEED]]
# Needs pip install 'mindlang[sb3,torch]'. FOLDER gets a copy of examples/collect; whatever is there is removed.
set -eu

folder=$1
ticks=${2:-12e6}
seed=${3:-1}
here=$(dirname "$0")
mind=$folder/collect.mind

show() {
  printf '\n$ %s\n' "$*"
  "$@"
}

rm -rf "$folder"
mkdir -p "$folder"
cp -r "$here/../collect/collect.mind" "$here/../collect/collect.lock" "$here/../collect/weights" "$folder"

show python "$here/teach.py" --ticks "$ticks" --seed "$seed" --out "$folder/goto.safetensors"

# In the lanes and in PyTorch the same bits; the shipped weights may do better, which --force is for.
show mindc weights import "$mind" GoToObject "$folder/goto.safetensors" --force
show mindc bench "$mind" --task GoToObject --runs 100 --seed 1
show mindc bench "$here/../collect/collect.mind" "$mind" --task Collect --runs 200 --seed 1

# A run in the lanes, computed again tick by tick by the engine of the robot.
show mindc run "$mind" --task Collect --seed 3 --record "$folder/collect.rec"
show mindc build "$mind" -o "$folder/collect.bundle"
show mindrun replay "$folder/collect.rec" "$folder/collect.bundle"
