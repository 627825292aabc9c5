
# Make a release the current one. The service stops before, under the wiring that it was started with, and starts after.
switch() { # RELEASE SERVICE KEEP SECONDS BACK LEFT; SERVICE is a file of the release, or none
    release=$1 service=$2 seconds=$4
    counted "$3" && counted "$4" || refuse "it cannot keep $3 releases or watch for $4 seconds"
    whole "$release" || refuse "$release is damaged"
    before=$(current)
    [ -d "$mind/releases/$before" ] || before= # somebody has deleted it
    armed=no
    ! cmp -s "$units/$unit" "$mind/current/mind-armed.service" || armed=yes
    [ -z "$before" ] || [ "$before" = "$release" ] || : >"$mind/releases/$before/WAS"
    stop || refuse 'the service cannot be stopped'
    if ! change "$release" "$service"; then
        start 0 || :
        refuse 'the new release cannot be made the current one'
    fi
    [ -z "$6" ] || [ ! -d "$mind/releases/$6" ] || : >"$mind/releases/$6/LEFT"
    tell current "$release"
    if ! start "$seconds"; then
        failed "$5"
    fi
    [ -n "$6" ] || prune "$3" || : # what is left lying there harms nothing
}

counted() { # NUMBER, which sh can compare
    case $1 in
    '' | ?????* | *[!0-9]*) false ;;
    esac
}

stop() {
    [ ! -e "$units/$unit" ] || systemctl --user stop "$unit"
}

# Never does a release run armed that nobody armed: to disarm comes first, to arm comes last.
change() { # RELEASE SERVICE
    case $2 in
    none) remove_service && point "$1" ;;
    mind.service) put "$1" "$2" && point "$1" ;;
    *) put "$1" mind.service && point "$1" && put "$1" "$2" ;;
    esac
}

point() { # RELEASE: one rename, so that there is always a current one
    rm -f "$mind/.current" && ln -s "releases/$1" "$mind/.current" && sync &&
        mv -T "$mind/.current" "$mind/current" && sync
}

put() { # RELEASE SERVICE
    mkdir -p "$units" && cp "$mind/releases/$1/$2" "$units/.$unit.new" && sync &&
        mv -T "$units/.$unit.new" "$units/$unit"
}

remove_service() {
    [ -e "$units/$unit" ] || return 0
    systemctl --user --quiet disable "$unit" && rm -f "$units/$unit" && systemctl --user daemon-reload
}

# Start the service, if there is one, and see it active at once and in each of some seconds.
start() { # SECONDS
    [ -e "$units/$unit" ] || return 0
    linger
    systemctl --user daemon-reload && systemctl --user --quiet enable "$unit" || return 1
    systemctl --user reset-failed "$unit" 2>/dev/null || :
    systemctl --user start "$unit" || return 1
    left=$1
    while systemctl --user --quiet is-active "$unit"; do
        [ "$left" -gt 0 ] || return 0
        sleep 1
        left=$((left - 1))
    done
    return 1
}

# Without it the service of a user starts at the first login, not with the robot.
linger() {
    [ -e "/var/lib/systemd/linger/$(id -un)" ] || loginctl enable-linger 2>/dev/null ||
        sudo -n loginctl enable-linger "$(id -un)" 2>/dev/null || tell unlingering "$(id -un)"
}

# Say why, and go back to the release before; armed only where it was armed, and is to be now.
failed() { # BACK
    tell failed "$release"
    journalctl --user -u "$unit" -n 12 --no-pager -o cat 2>/dev/null | while read -r line; do
        tell log "$line"
    done || :
    if [ "$1" = no ] || [ -z "$before" ] || [ "$before" = "$release" ] || ! whole "$before"; then
        refuse 'the service does not stay up'
    fi
    [ "$armed" = yes ] || service=mind.service
    stop || :
    change "$before" "$service" || refuse 'the release before cannot be made the current one again'
    : >"$mind/releases/$release/LEFT"
    rm -f "$mind/releases/$before/LEFT"
    tell back "$before"
    start "$seconds" || refuse 'the service does not stay up with the release before either'
    refuse 'the service does not stay up with the new release'
}

# Keep the current release, and of those that one could go back to the newest.
prune() { # KEEP
    now=$(current)
    kept=1
    ls -1r "$mind/releases" | while read -r name; do
        if [ "$name" = "$now" ] || ! named "$name"; then
            continue
        elif [ -e "$mind/releases/$name/WAS" ] && [ ! -e "$mind/releases/$name/LEFT" ] && [ "$kept" -lt "$1" ]; then
            kept=$((kept + 1))
        else
            discard "$name"
        fi
    done
    find "$mind/incoming" -mindepth 1 -maxdepth 1 -mmin +60 -exec rm -rf {} +
}

discard() { # RELEASE: out of releases/ in one step, so that what is there is whole
    rm -rf "$mind/incoming/$1"
    mv -T "$mind/releases/$1" "$mind/incoming/$1"
    rm -rf "$mind/incoming/$1"
}
