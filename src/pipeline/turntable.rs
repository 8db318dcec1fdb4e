//! Sequences of pictures of a mesh that turns, and films of them.

use std::{
    path::{Path, PathBuf},
    process::{Command, Stdio},
};

use super::PipelineError;

/// Pictures a second of a film.
const RATE: u32 = 24;

/// The file of picture `index` of `count`: in its name a number stands for the run of #s, as wide as they are or as the last number is.
#[must_use]
pub fn numbered(path: &Path, index: u32, count: u32) -> PathBuf {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let Some(start) = name.find('#') else { return path.to_owned() };
    let marks = name[start..].chars().take_while(|mark| *mark == '#').count();
    let width = marks.max(count.saturating_sub(1).to_string().len());
    path.with_file_name(format!("{}{index:0width$}{}", &name[..start], &name[start + marks..]))
}

/// Whether ffmpeg can be run, which makes films.
///
/// # Errors
/// [`PipelineError::NoFfmpeg`].
pub fn check_ffmpeg() -> Result<(), PipelineError> {
    let ran = Command::new("ffmpeg").arg("-version").stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null()).status();
    match ran {
        Ok(status) if status.success() => Ok(()),
        _ => Err(PipelineError::NoFfmpeg),
    }
}

/// Picture `index` of the film `film`, in a folder beside it.
#[must_use]
pub fn frame(film: &Path, index: u32) -> PathBuf {
    frames(film).join(format!("{index:06}.png"))
}

/// The folder of a film's pictures.
#[must_use]
pub fn frames(film: &Path) -> PathBuf {
    film.with_extension("frames")
}

/// Makes `film` of its first `count` pictures, as [`frame`] calls them. It appears whole or not at all.
///
/// # Errors
/// [`PipelineError::Ffmpeg`] with what ffmpeg says.
pub fn encode(film: &Path, count: u32) -> Result<(), PipelineError> {
    let failed = |message: String| PipelineError::Ffmpeg { path: film.to_owned(), message };
    let (rate, count) = (RATE.to_string(), count.to_string());
    // Players want an even number of columns and rows, and this form of colour. Names are those of this program alone: ffmpeg reads signs into
    // others.
    let arguments = [
        "-hide_banner",
        "-loglevel",
        "error",
        "-y",
        "-framerate",
        &rate,
        "-i",
        "%06d.png",
        "-frames:v",
        &count,
        "-vf",
        "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white,format=yuv420p",
        "-c:v",
        "libx264",
        "-crf",
        "16",
        "-movflags",
        "+faststart",
        "film.mp4",
    ];
    let output = Command::new("ffmpeg").args(arguments).current_dir(frames(film)).stdin(Stdio::null()).output();
    let output = output.map_err(|error| failed(error.to_string()))?;
    if !output.status.success() {
        return Err(failed(format!("{}: {}", output.status, String::from_utf8_lossy(&output.stderr).trim())));
    }
    std::fs::rename(frames(film).join("film.mp4"), film).map_err(|error| failed(error.to_string()))
}
