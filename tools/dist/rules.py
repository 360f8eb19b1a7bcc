#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# rules.py arduino|idf FOLDER - holds a package against the published rules of its registry, and prints a line for each that it breaks:
# those of arduino-lint for a library and its sketches, at the level "strict" (arduino.github.io/arduino-lint, whose names of rules
# these are), and those of ESP-IDF's component manager for idf_component.yml and what a registry takes (docs.espressif.com,
# "idf_component.yml Manifest File"). Exit status 1 where there is one. Not looked at is what needs the network or an index: whether a
# name is taken (LP017, LP018), a URL answers (LP042), a tag says the version (LP022), a dependency exists (LP048).
import os
import re
import sys

findings = []


def expect(rule, holds, text):
    if not holds:
        findings.append('%s: %s' % (rule, text))


def read(path):
    with open(path, encoding='utf-8') as file:
        return file.read()


def files_of(folder):
    for here, folders, names in os.walk(folder):
        for name in names + [f for f in folders if os.path.islink(os.path.join(here, f))]:
            yield os.path.relpath(os.path.join(here, name), folder)


SEMVER = r'(0|[1-9]\d*)\.(0|[1-9]\d*)\.(0|[1-9]\d*)(-[0-9A-Za-z-]+(\.[0-9A-Za-z-]+)*)?(\+[0-9A-Za-z-]+(\.[0-9A-Za-z-]+)*)?'
PROJECT_NAME = r'[A-Za-z0-9_][A-Za-z0-9_.-]{0,62}'

# ---------------------------------------------------------------------- Arduino

FIELDS = ['name', 'version', 'author', 'maintainer', 'sentence', 'paragraph', 'category', 'url', 'architectures', 'depends', 'includes',
          'dot_a_linkage', 'precompiled', 'ldflags']
CATEGORIES = ['Display', 'Communication', 'Signal Input/Output', 'Sensors', 'Device Control', 'Timing', 'Data Storage', 'Data Processing',
              'Other']
# Rule of a field that is missing, and of one that is empty.
REQUIRED = {'name': ('LP007', 'LP008'), 'version': ('LP019', 'LP020'), 'author': ('LP023', 'LP024'), 'maintainer': ('LP025', 'LP026'),
            'sentence': ('LP031', 'LP032'), 'paragraph': ('LP034', None), 'category': ('LP037', None), 'url': ('LP040', 'LP056'),
            'architectures': ('LP043', 'LP044')}
# What people write for the names of Arduino's own cores.
ARCHITECTURES = ['*', 'avr', 'esp32', 'esp8266', 'mbed', 'mbed_edge', 'mbed_giga', 'mbed_nano', 'mbed_nicla', 'mbed_opta', 'mbed_portenta',
                 'mbed_rp2040', 'megaavr', 'nrf52', 'renesas_portenta', 'renesas_uno', 'rp2040', 'sam', 'samd', 'stm32', 'teensy', 'zephyr']


def library_fields(text):
    fields = {}
    for number, line in enumerate(text.split('\n'), 1):
        if line.strip() == '' or line.lstrip().startswith('#'):
            continue
        expect('LP005', '=' in line, 'library.properties:%d: no field=value' % number)
        name, _, value = line.partition('=')
        fields[name.strip()] = value.strip()
    return fields


def check_name(name):
    expect('LP009', len(name) <= 63, 'name: longer than 63 characters')
    expect('LP010', len(name) <= 16, 'name: longer than the 16 characters that are recommended')
    expect('LP011', re.fullmatch(r'(?=.*[A-Za-z])[A-Za-z0-9][A-Za-z0-9 _.-]*', name), 'name: characters that are not allowed')
    expect('LP012', not name.lower().startswith('arduino'), 'name: begins with Arduino')
    expect('LP014', 'arduino' not in name.lower()[1:], 'name: contains Arduino')
    expect('LP015', ' ' not in name, 'name: contains spaces')
    expect('LP016', 'library' not in name.lower(), 'name: contains library')


def check_fields(folder, fields):
    for name, (missing, empty) in REQUIRED.items():
        expect(missing, name in fields, 'library.properties: no %s' % name)
        if name in fields and empty is not None:
            expect(empty, fields[name] != '', 'library.properties: %s is empty' % name)
    for name in fields:
        expect('LP028', name != 'email', 'library.properties: email is an old name of maintainer')
        expect('LP006', name in FIELDS or name == 'email', 'library.properties: no field is called %s' % name)
    check_name(fields.get('name', 'x'))
    expect('LP021', re.fullmatch(SEMVER, fields.get('version', '1.0.0')), 'version: not A.B.C')
    maintainer, sentence, paragraph = fields.get('maintainer', ''), fields.get('sentence', ''), fields.get('paragraph', '')
    expect('LP027', not maintainer.lower().startswith('arduino'), 'maintainer: begins with Arduino')
    expect('LP057', 'arduino' not in maintainer.lower()[1:], 'maintainer: contains Arduino')
    for rule, text in ('LP033', sentence), ('LP035', paragraph):
        expect(rule, not re.search(r'\b(aduino|arduno|ardiuno|ardunio|recieve|seperate|lenght|wich|teh)\b', text, re.I), 'a common misspelling in "%.40s"' % text)
    expect('LP036', sentence == '' or not paragraph.startswith(sentence), 'paragraph: repeats the sentence')
    category = fields.get('category', 'Other')
    expect('LP039', category != 'Uncategorized', 'category: Uncategorized')
    expect('LP038', category in CATEGORIES + ['Uncategorized'], 'category: "%s" is none' % category)
    expect('LP041', re.fullmatch(r'https?://[^\s/]+\.[^\s]*', fields.get('url', 'https://a.b')), 'url: no http or https address')
    names = [name.strip() for name in fields.get('architectures', '*').split(',')]
    for name in names:
        known = [a for a in ARCHITECTURES if a.lower() == name.lower()]
        expect('LP046', not known or name in known, 'architectures: %s is written %s' % (name, known[0] if known else ''))
    expect('LP045', names != ['mbed'], 'architectures: mbed alone is an alias')
    expect('LP047', re.fullmatch(r'([A-Za-z0-9][^,()]*(\([^()]*\))?(, *|$))*', fields.get('depends', '')), 'depends: not NAME (CONSTRAINT), ...')
    for constraint in re.findall(r'\(([^()]*)\)', fields.get('depends', '')):
        expect('LP058', re.fullmatch(r' *(<|<=|=|>=|>|\^)\d+(\.\d+){0,2} *', constraint), 'depends: no constraint: (%s)' % constraint)
    expect('LP049', fields.get('dot_a_linkage', 'true') in ('true', 'false'), 'dot_a_linkage: neither true nor false')
    expect('LP053', fields.get('precompiled', 'true') in ('true', 'full', 'false'), 'precompiled: neither true, full nor false')
    expect('LP055', fields.get('ldflags', 'x') != '', 'ldflags: empty')
    expect('LP051', fields.get('includes', 'x') != '', 'includes: empty')
    for name in fields.get('includes', '').split(','):
        expect('LP052', name == '' or os.path.isfile(os.path.join(folder, 'src', name.strip())), 'includes: no src/%s' % name)


def check_sketch(folder, path):
    name = os.path.basename(path)
    inos = [f for f in os.listdir(os.path.join(folder, path)) if f.endswith(('.ino', '.pde'))]
    expect('SS001', name + '.ino' in inos or name + '.pde' in inos, '%s: no %s.ino' % (path, name))
    for file in os.listdir(os.path.join(folder, path)):
        expect('SS002', re.fullmatch(r'[A-Za-z0-9_][A-Za-z0-9_.-]*', file), '%s/%s: characters that are not allowed' % (path, file))
        expect('SS003', len(file) <= 63 + 4, '%s/%s: too long' % (path, file))
        expect('SS004', not file.endswith('.pde'), '%s/%s: .pde is an old ending' % (path, file))
        expect('SS005', file.lower() != 'src' or file == 'src', '%s/%s: is to be src' % (path, file))


def check_arduino(folder):
    entries = os.listdir(folder)
    paths = sorted(files_of(folder))
    name = os.path.basename(os.path.abspath(folder))
    expect('LS001', any(re.fullmatch(r'src/[^/]+\.(h|hh|hpp)', p) for p in paths), 'no header in src')
    expect('LS002', len(name) <= 63, 'folder: longer than 63 characters')
    expect('LS003', re.fullmatch(PROJECT_NAME, name), 'folder: characters that are not allowed')
    expect('LS004', '.gitmodules' not in entries, 'a submodule')
    for path in paths:
        expect('LS005', not os.path.islink(os.path.join(folder, path)), path + ': a link')
        expect('LS007', not path.endswith('.exe'), path + ': a program')
        if path.endswith(('.h', '.hpp', '.c', '.cpp', '.ino')) and not os.path.islink(os.path.join(folder, path)):
            rule = 'SC001' if path.startswith('examples/') else 'LC001'
            expect(rule, not re.search(r'#\s*include\s*[<"](?!Arduino\.h)[Aa][Rr][Dd][Uu][Ii][Nn][Oo]\.[Hh][>"]', read(os.path.join(folder, path))),
                   path + ': is Arduino.h')
    expect('LS006', '.development' not in entries, '.development is there')
    for entry in entries:
        if os.path.isdir(os.path.join(folder, entry)):
            expect('LS009', entry.lower() != 'src' or entry == 'src', entry + ': is to be src')
            expect('LS011', entry.lower() != 'extra', entry + ': is to be extras')
            expect('LS012', entry.lower() != 'extras' or entry == 'extras', entry + ': is to be extras')
            expect('LD005', entry.lower() != 'example', entry + ': is to be examples')
            expect('LD006', entry.lower() != 'examples' or entry == 'examples', entry + ': is to be examples')
        else:
            misspelt = re.fullmatch(r'(?i)librar(y|ie)s?[._-]?propert(y|ie)s?', entry)
            expect('LP002', not misspelt or entry.lower() == 'library.properties', entry + ': is to be library.properties')
            expect('LP003', entry.lower() != 'library.properties' or entry == 'library.properties', entry + ': is to be library.properties')
    expect('LS010', 'utility' not in entries, 'utility beside src')
    expect('LP004', not os.path.exists(os.path.join(folder, 'src', 'library.properties')), 'src/library.properties')
    expect('LD001', any(re.fullmatch(r'(?i)readme(\.(md|txt|rst|adoc))?', e) for e in entries), 'no README.md')
    expect('LD002', any(re.fullmatch(r'(?i)(un)?licen[cs]e(\.(md|txt))?|copying(\.(md|txt))?', e) for e in entries), 'no LICENSE')
    sketches = sorted({os.path.dirname(p) for p in paths if p.endswith(('.ino', '.pde'))})
    for path in sketches:
        expect('LD003', path.split('/')[0] == 'examples' and path != 'examples', (path or '.') + ': a sketch outside of examples')
        check_sketch(folder, path)
    expect('LD004', any(s.startswith('examples/') for s in sketches), 'no sketch in examples')
    has = 'library.properties' in entries
    expect('LP001', has, 'no library.properties')
    if has:
        fields = library_fields(read(os.path.join(folder, 'library.properties')))
        check_fields(folder, fields)
        header = re.sub(r'[^A-Za-z0-9_.-]', '_', fields.get('name', ''))
        expect('LS008', any(os.path.splitext(p)[0] == 'src/' + header for p in paths if p.endswith(('.h', '.hpp'))), 'no header src/%s.h' % header)


# ---------------------------------------------------------------------- ESP-IDF

MANIFEST = ['name', 'version', 'targets', 'maintainers', 'description', 'license', 'tags', 'dependencies', 'files', 'examples', 'url',
            'repository', 'documentation', 'issues', 'discussion', 'repository_info']
DEPENDENCY = ['version', 'public', 'path', 'git', 'registry_url', 'service_url', 'rules', 'matches', 'override_path', 'require', 'pre_release']
LICENSES = ['MIT', 'MIT-0', 'Apache-2.0', 'BSD-2-Clause', 'BSD-3-Clause', 'ISC', 'Zlib', 'Unlicense', 'CC0-1.0', 'MPL-2.0', 'LGPL-2.1-only',
            'LGPL-2.1-or-later', 'LGPL-3.0-only', 'LGPL-3.0-or-later', 'GPL-2.0-only', 'GPL-2.0-or-later', 'GPL-3.0-only', 'GPL-3.0-or-later']
SLUG = r'[A-Za-z\d]+(?:(?:[_-](?![_-]+))|[A-Za-z\d])*[A-Za-z\d]+'
VERSION_SPEC = r'\*|(([<>]=?|==|!=|~=?|\^|~)? *\d+(\.[\d*]+){0,2}[\w.+-]*)( *, *([<>]=?|==|!=|~=?|\^|~)? *\d+(\.[\d*]+){0,2}[\w.+-]*)*'


def scalar(text):
    text = text.strip()
    if text.startswith('[') and text.endswith(']'):
        return [scalar(part) for part in text[1:-1].split(',') if part.strip()]
    if len(text) >= 2 and text[0] == text[-1] and text[0] in '"\'':
        return text[1:-1]
    return text


# The part of YAML that such manifests are written in: maps and lists by indentation, lists in brackets, plain and quoted scalars.
def parse(path):
    lines = []
    for line in read(path).split('\n'):
        if line.strip() and not line.lstrip().startswith('#'):
            lines.append((len(line) - len(line.lstrip()), line.strip()))

    def block(at, indent):
        out = [] if at < len(lines) and lines[at][1].startswith('- ') else {}
        while at < len(lines) and lines[at][0] == indent:
            text = lines[at][1]
            if isinstance(out, list):
                if not text.startswith('- '):
                    raise ValueError('%s: "%s" in a list' % (path, text))
                if re.match(r'- *[A-Za-z_/-]+:( |$)', text):
                    inner = indent + text.index(text[1:].lstrip()[0], 1)
                    lines[at] = (inner, text[1:].strip())
                    value, at = block(at, inner)
                else:
                    value, at = scalar(text[2:]), at + 1
                out.append(value)
                continue
            key, colon, rest = text.partition(':')
            if not colon:
                raise ValueError('%s: "%s" is no KEY: VALUE' % (path, text))
            if rest.strip():
                out[scalar(key)], at = scalar(rest), at + 1
            elif at + 1 < len(lines) and lines[at + 1][0] > indent:
                out[scalar(key)], at = block(at + 1, lines[at + 1][0])
            else:
                out[scalar(key)], at = None, at + 1
        return out, at

    value, at = block(0, 0)
    if at < len(lines):
        raise ValueError('%s: "%s" stands too far in or out' % (path, lines[at][1]))
    return value


def is_unique_list(value):
    return isinstance(value, list) and all(isinstance(v, str) for v in value) and len(set(value)) == len(value)


def check_dependencies(folder, where, dependencies):
    expect('dependencies', isinstance(dependencies, dict), where + ': no map of names')
    for name, value in dependencies.items() if isinstance(dependencies, dict) else []:
        expect('dependency name', re.fullmatch(r'%s(/%s)?' % (SLUG, SLUG), name) and '__' not in name, '%s: %s is no name' % (where, name))
        value = value if isinstance(value, dict) else {'version': value}
        for key in value:
            expect('dependency field', key in DEPENDENCY, '%s: %s: no field is called %s' % (where, name, key))
        version = value.get('version', '*')
        expect('dependency version', 'git' in value or (isinstance(version, str) and re.fullmatch(VERSION_SPEC, version)),
               '%s: %s: no version: %s' % (where, name, version))
        if 'override_path' in value:
            path = os.path.normpath(os.path.join(folder, value['override_path']))
            expect('override_path', os.path.isfile(os.path.join(path, 'CMakeLists.txt')), '%s: %s: no component at %s' % (where, name, value['override_path']))


def check_manifest(folder, manifest):
    for key in manifest:
        expect('field', key in MANIFEST, 'no field is called %s' % key)
    expect('version', re.fullmatch(SEMVER + r'(~\d+)?', str(manifest.get('version'))), 'version: missing, or not A.B.C')
    description = manifest.get('description')
    expect('description', isinstance(description, str) and description != '', 'description: missing')
    expect('license', manifest.get('license') in LICENSES, 'license: no identifier of SPDX')
    expect('license file', any(e in os.listdir(folder) for e in ('LICENSE', 'LICENSE.txt', 'LICENSE.md')), 'no LICENSE')
    expect('targets', 'targets' not in manifest, 'targets: shuts out chips to come; without it all are supported')
    for key in 'tags', 'maintainers':
        expect(key, key not in manifest or is_unique_list(manifest[key]), '%s: no list of different texts' % key)
    for tag in manifest.get('tags') or []:
        expect('tag', re.fullmatch(r'[A-Za-z0-9_-]{3,32}', str(tag)), 'tags: "%s" has not 3 to 32 letters, digits, _ and -' % tag)
    for key in 'url', 'documentation', 'issues', 'discussion':
        expect('address', key not in manifest or re.fullmatch(r'https?://[^\s/]+\.\S+', str(manifest[key])), '%s: no http or https address' % key)
    expect('url', 'url' in manifest, 'url: missing')
    repository = manifest.get('repository')
    expect('repository', repository is None or re.fullmatch(r'(git|ssh|https?|git@[-\w.]+):(//)?\S+', str(repository)), 'repository: no address of git')
    expect('repository_info', 'repository_info' not in manifest or repository is not None, 'repository_info: needs repository')
    files = manifest.get('files') or {}
    expect('files', set(files) <= {'use_gitignore', 'include', 'exclude'}, 'files: %s' % ', '.join(files))
    check_dependencies(folder, 'dependencies', manifest.get('dependencies') or {})
    examples = manifest.get('examples') or []
    expect('examples', isinstance(examples, list) and all(isinstance(e, dict) and 'path' in e for e in examples), 'examples: no list of paths')
    for example in examples if isinstance(examples, list) else []:
        path = os.path.join(folder, example.get('path', '')) if isinstance(example, dict) else folder
        expect('example', os.path.isfile(os.path.join(path, 'CMakeLists.txt')) and os.path.isfile(os.path.join(path, 'main', 'CMakeLists.txt')),
               'examples: no project at %s' % example)


def check_idf(folder):
    expect('README', os.path.isfile(os.path.join(folder, 'README.md')) and read(os.path.join(folder, 'README.md')).strip() != '', 'no README.md')
    expect('CMakeLists.txt', os.path.isfile(os.path.join(folder, 'CMakeLists.txt'))
           and 'idf_component_register' in read(os.path.join(folder, 'CMakeLists.txt')), 'no CMakeLists.txt that registers a component')
    manifests = [p for p in sorted(files_of(folder)) if os.path.basename(p) == 'idf_component.yml']
    expect('manifest', 'idf_component.yml' in manifests, 'no idf_component.yml')
    for path in manifests:
        try:
            manifest = parse(os.path.join(folder, path))
        except ValueError as error:
            expect('YAML', False, str(error))
            continue
        if path == 'idf_component.yml':
            check_manifest(folder, manifest)
        else:
            check_dependencies(os.path.join(folder, os.path.dirname(path)), path, manifest.get('dependencies') or {})


checks = {'arduino': check_arduino, 'idf': check_idf}
if len(sys.argv) != 3 or sys.argv[1] not in checks or not os.path.isdir(sys.argv[2]):
    sys.exit('usage: rules.py arduino|idf FOLDER')
checks[sys.argv[1]](sys.argv[2])
for finding in findings:
    print('%s: %s' % (sys.argv[2], finding))
sys.exit(1 if findings else 0)
