# The robot's part of `mindc deploy`, for any POSIX sh: sent over stdin, and called in its last line, so that a script
# which arrives in half does nothing. A lost connection does not stop what has begun.
set -eu
umask 022
LC_ALL=C
: "${XDG_RUNTIME_DIR:=/run/user/$(id -u)}"
export LC_ALL XDG_RUNTIME_DIR
trap '' HUP PIPE

mind=$HOME/mind
units=$HOME/.config/systemd/user
unit=mind.service
patience=60

main() {
    verb=$1
    shift
    if [ "$verb" != look ]; then
        mkdir -p "$mind/releases" "$mind/incoming"
        case $verb in
        hold) # from the first step to the last
            exec 9>"$mind/deploying"
            flock -n 9 || tell waiting ''
            ;;
        *) exec 9>"$mind/lock" ;;         # what has begun and goes on without its workstation
        esac
        flock -w "$patience" 9 || refuse 'another deployment is under way'
    fi
    "$verb" "$@"
}

# Let no other deployment begin until the workstation ends, or nothing has been heard of it for a while.
hold() {
    tell held ''
    while [ "$(timeout 30 head -c 1)" ]; do :; done
}

tell() { # EVENT DETAIL
    printf '%s\t%s\n' "$1" "$2" 2>/dev/null || :
}

refuse() { # WHY
    tell refused "$1"
    exit 9
}

current() {
    basename "$(readlink "$mind/current" || :)"
}

# Whether a name is that of a release: what else somebody keeps there is not ours.
named() { # NAME
    case $1 in
    *[!0-9a-fTZ-]*) false ;;
    ????????T??????Z-????????) ;;
    *) false ;;
    esac
}

whole() { # RELEASE: every byte is what its name stands for
    (
        cd "$mind/releases/$1" 2>/dev/null &&
            [ "$(sha256sum <SHA256SUMS | cut -c1-8)" = "${1##*-}" ] &&
            sha256sum --status -c SHA256SUMS
    ) 2>/dev/null
}

# What is there; changes nothing. In a release WAS says that it was current until another became it, LEFT that this
# other was an older one; without either it is the current one, or what an interrupted deployment made and never used.
look() {
    for tool in rsync python3 sha256sum flock; do
        command -v "$tool" >/dev/null || tell lacks "$tool"
    done
    python3 -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null || tell lacks 'Python 3.11 or newer'
    systemctl --user show-environment >/dev/null 2>&1 || tell lacks 'systemctl --user'
    tell current "$(current)"
    for folder in "$mind"/releases/*/; do
        name=$(basename "$folder")
        named "$name" && [ -d "$folder" ] || continue
        state=damaged
        ! whole "$name" || state=whole
        [ "$name" = "$(current)" ] || [ -e "$folder/WAS" ] || state=unused
        [ ! -e "$folder/LEFT" ] || state=left
        tell release "$name $state $(head -c 4096 "$folder/release.json" 2>/dev/null | tr '\n\t' '  ')"
    done
}

# Make the environment that all releases share, once; one that was not finished, or lost its numpy, is made again.
prepare() {
    if [ -e "$mind/venv/whole" ] && has_numpy; then
        return
    fi
    tell step 'making an environment for Python'
    python3 -m venv --clear --system-site-packages --without-pip "$mind/venv" >&2
    if ! has_numpy; then
        python3 -m venv --clear --system-site-packages "$mind/venv" >&2 &&
            "$mind/venv/bin/python" -m pip install --quiet 'numpy>=1.26' >&2 || :
    fi
    has_numpy || refuse 'numpy is not there and cannot be installed: sudo apt install python3-numpy'
    : >"$mind/venv/whole"
    sync
}

has_numpy() {
    "$mind/venv/bin/python" -c 'import sys, importlib.util as look; sys.exit(not look.find_spec("numpy"))' 2>/dev/null
}

# Make a release of what was copied, if it is what was sent and can be read here.
accept() { # FINGERPRINT RELEASE
    came=$mind/incoming/$1
    if ! (cd "$came" && echo "$1  SHA256SUMS" | sha256sum --status -c - && sha256sum --status -c SHA256SUMS); then
        rm -rf "$came" # what is wrong in a file of the right size and date, rsync would not mend
        refuse 'what arrived is not what was sent'
    fi
    if ! (cd "$came" && PYTHONPATH=runtime PYTHONDONTWRITEBYTECODE=1 \
        "$mind/venv/bin/python" -m mindrun mind.bundle --json >/dev/null); then
        refuse 'the bundle cannot be read by the Python of this robot'
    fi
    sync # what a name in releases/ stands for is on the disk before the name is
    mv -T "$came" "$mind/releases/$2"
    sync
}
